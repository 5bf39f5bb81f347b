// SPDX-License-Identifier: GPL-3.0-or-later
// vdb: a level set and the velocities beside it, in voxels of half a spacing (vdb/VdbFile.H).

#include "MovingFormat.H"
#include "vdb/VdbFile.H"

namespace shizuku
{

class MovingVdb : public MovingFormat
{
public:
    void write(const std::filesystem::path& file, const MovingSurface& surface) const override
    {
        writeVdb(file, *surface.closed, surface.velocitiesAt, 0.5*surface.spacing, surface.time);
    }
};

static const MovingFormatTable::Add<MovingVdb> registeredVdb{"vdb"};

}
