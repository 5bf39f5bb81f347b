// SPDX-License-Identifier: GPL-3.0-or-later
// Akinci, Akinci and Teschner 2013, Versatile surface tension and adhesion for SPH fluids: cohesion and area
// minimisation among liquid particles; solids do not touch the normals.
//
//     surfaceTension  Akinci2013;

#include "models/surfaceTension/pairTension/PairTension.H"

namespace shizuku
{

namespace
{

using Akinci2013 = PairTensionOf<PairTension::WallNormals::no>;

const SurfaceTensionTable::Add<Akinci2013> registered{"Akinci2013", "cohesion and area minimisation (Akinci, Akinci and Teschner 2013)"};

}

}
