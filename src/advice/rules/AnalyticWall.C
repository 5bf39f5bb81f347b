// SPDX-License-Identifier: GPL-3.0-or-later
// Does a wall need to be sampled with particles?
//
// A flat surface of one contact angle, below all of the liquid, can be a `plane`: exact, without particles. What it changes
// is what the ladder's rung `walls` measured between the two, in degrees over theta.

#include "advice/Rule.H"

namespace shizuku
{

namespace
{

class AnalyticWall : public AdviceRule
{
public:
    std::optional<Advice> advise(Scene& scene) const override
    {
        // What the rung was run with.
        if (scene.models.at("surfaceTension") != scene.studies->standard().surfaceTension) return std::nullopt;
        for (SceneWall& wall : scene.walls)
        {
            if (wall.type != "particles") continue;
            const std::string reason = obstacle(wall, scene);
            if (!reason.empty()) return Advice{"keep particles", reason, "constant/triSurface, constant/wettability"};
            // The rung's own step: a longer one changes both walls alike (doc/notebook/advice.md: 0.1 % between them at four times its length).
            const std::vector<double> steps = scene.studies->steps("analyticWall", "default");
            if (steps.empty()) return std::nullopt;
            const auto change = scene.studies->error
            (
                "analyticWall", *wall.theta, "default", scene.particles(scene.smallest()), steps.front()
            );
            if (!change) return std::nullopt;
            Advice advice
            {
                "keep particles", "a plane in place of the particles of '" + wall.name + "' changes the contact angle by " +
                percent(change->value), change->source + ", rung walls"
            };
            if (change->value > scene.tolerance) return advice;
            advice.verdict = "take a plane for '" + wall.name + "'";
            advice.reason += "; the liquid must not run over its edge, which a plane does not have";
            wall.type = "plane";
            const std::string point = str(wall.plane->point), normal = str(wall.plane->normal);
            advice.changes =
            {
                {"constant/walls", wall.name, "{ type plane; point " + point + "; normal " + normal + "; }"}
            };
            return advice;
        }
        return std::nullopt;
    }

private:
    // Why it cannot be a plane; empty where it can.
    static std::string obstacle(const SceneWall& wall, const Scene& scene)
    {
        if (!wall.plane) return "the surface of '" + wall.name + "' is no plane";
        if (!wall.evenTheta || !wall.theta) return "the contact angle of '" + wall.name + "' is not the same everywhere";
        if (!coversLiquid(wall, scene)) return "there is liquid beyond the edge of '" + wall.name + "'";
        return "";
    }

    // The liquid stands over the surface's box, seen along the normal.
    static bool coversLiquid(const SceneWall& wall, const Scene& scene)
    {
        const Vector3 centre = 0.5*(wall.low + wall.high), reach = 0.5*(wall.high - wall.low);
        for (const SceneBody& body : scene.bodies)
        {
            const Vector3 middle = 0.5*(body.liquid.low + body.liquid.high);
            const Vector3 foot = middle - wall.plane->distance(middle)*wall.plane->normal - centre;
            for (int c = 0; c < 3; ++c)
            {
                if (std::abs(wall.plane->normal[c]) > 0.9) continue;
                if (std::abs(foot[c]) + 0.5*body.liquid.size()[c] > reach[c]) return false;
            }
        }
        return true;
    }
};

const AdviceRules::Add<AnalyticWall> registered{"analyticWall"};

}

}
