// SPDX-License-Identifier: GPL-3.0-or-later
// Fujisawa, Imai and Mikawa 2014, Fluid-solid interaction simulation using inter-particle potential force: as Akinci et
// al. 2013, with the solids' share A(theta) = 1 + cos theta in the normals, equations (22) and (23).
//
//     surfaceTension  Fujisawa2014;

#include "models/surfaceTension/pairTension/PairTension.H"

namespace shizuku
{

namespace
{

using Fujisawa2014 = PairTensionOf<PairTension::WallNormals::yes>;

const SurfaceTensionTable::Add<Fujisawa2014> registered{"Fujisawa2014", "as Akinci2013, with the solids' share in the normals (Fujisawa, Imai and Mikawa 2014)"};

}

}
