// SPDX-License-Identifier: GPL-3.0-or-later
// type regions; theta 90;              // degrees, outside of all regions
// regions
// {
//     spot { type sphere; centre (0 0 0); radius 1e-3; theta 30; }
// }
// The shapes are those of bodies of liquid (see liquidBodies/LiquidBody.H). Where regions overlap the last one counts.
// Solid particles lie half a spacing inside the solid: a region has to reach that far below the surface.

#include "liquidBodies/LiquidBody.H"
#include "thetaModels/ThetaModel.H"

namespace shizuku
{

class RegionsTheta : public ThetaModel
{
public:
    RegionsTheta(const Dictionary& dict, const std::filesystem::path& casePath) : elsewhere_(readTheta(dict, "theta"))
    {
        const Dictionary regions = dict.subDict("regions");
        for (const std::string& name : regions.dictKeys())
        {
            const Dictionary region = regions.subDict(name);
            const std::string type = region.lookup<std::string>("type");
            auto shape = LiquidBodyTable::New("region", type, region.where("type"), region, casePath);
            regions_.push_back({std::move(shape), readTheta(region, "theta")});
        }
        if (regions_.empty())
        {
            throw FatalInputError(regions.where(), "There is no region", "spot { type sphere; ...; theta 30; }");
        }
    }

    double theta(const Vector3& x) const override
    {
        double theta = elsewhere_;
        for (const Region& region : regions_)
        {
            if (region.shape->contains(x)) theta = region.theta;
        }
        return theta;
    }

private:
    struct Region
    {
        std::unique_ptr<LiquidBody> shape;
        double theta;
    };

    double elsewhere_;
    std::vector<Region> regions_;
};

static const ThetaModelTable::Add<RegionsTheta> registered{"regions"};

}
