#include "models/pressure/pbf/Pbf.H"

#include "device/Reduce.H"
#include "maths/Lattice.H"
#include "models/density/Density.H"

namespace shizuku
{

namespace
{

const PressureTable::Add<Pbf> registered{"pbf"};

// Sum of |V grad W|^2 over the cubic lattice: the scale of epsilon.
float bulkSum(const Liquid& liquid)
{
    return std::visit
    (
        [&](const auto& W)
        {
            const auto square = [&](float r) { return W.g(r) * r * W.g(r) * r; };
            return liquid.particleVolume() * latticeSum(liquid.spacing(), W.h, square);
        },
        liquid.kernel()
    );
}

template<class Kernel>
struct Multiplier
{
    Kernel W;
    float volume, densityVolume;        // V, V/S
    float epsilon;
    bool selfGradient, unilateral;
    Span<const Vec3> x;
    NeighbourView near;
    WallView walls;
    Span<float> density, multiplier;

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 xi = x[i];
        float liquid = W.W(0), squares = 0;
        Vec3 sum;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            const float distance = norm(r);
            liquid += W.W(distance);
            const Vec3 gradient = volume * W.g(distance) * r;
            squares += squared(gradient);
            sum += gradient;
        });
        const auto wall = walls.surfaces.density(xi);
        float solid = wall.value;
        squares += squared(wall.gradient);
        sum += wall.gradient;
        walls.particles.near.forEach(i, [&](int k)
        {
            const Vec3 r = xi - walls.particles.position[k];
            const float distance = norm(r);
            solid += walls.particles.volume[k] * W.W(distance);
            const Vec3 gradient = walls.particles.volume[k] * W.g(distance) * r;
            squares += squared(gradient);
            sum += gradient;
        });
        density[i] = densityVolume * liquid + solid;
        float C = density[i] - 1;
        if (unilateral) C = fmaxf(C, 0);
        multiplier[i] = C / (squares + (selfGradient ? squared(sum) : 0) + epsilon);
    }
};

template<class Kernel>
struct Correction
{
    Kernel W;
    float volume, relaxation;
    Span<const Vec3> x;
    NeighbourView near;
    WallView walls;
    Span<const float> multiplier;
    Span<Vec3> corrected;

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 xi = x[i];
        const float si = multiplier[i];
        Vec3 step = si * walls.surfaces.density(xi).gradient;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            step += volume * (si + multiplier[j]) * W.g(norm(r)) * r;
        });
        walls.particles.near.forEach(i, [&](int k)
        {
            const Vec3 r = xi - walls.particles.position[k];
            step += walls.particles.volume[k] * si * W.g(norm(r)) * r;
        });
        corrected[i] = xi - relaxation * step;
    }
};

struct AddPotential
{
    float relaxation;
    Span<const float> multiplier;
    Span<float> potential;

    HOST_DEVICE void operator()(int i) const { potential[i] += relaxation * multiplier[i]; }
};

template<class Sum>
struct Compression
{
    Span<const float> density;

    HOST_DEVICE Sum operator()(int i) const { return {fmaxf(density[i] - 1, 0)}; }
};

Pbf::Parameters readParameters(const Dictionary& dict, const Liquid& liquid)
{
    Pbf::Parameters p;
    p.minIterations = dict.lookupOr("minIterations", 2);
    p.maxIterations = dict.lookupOr("maxIterations", 10);
    p.tolerance = dict.lookupOr("tolerance", 1e-3);
    p.relaxation = float(dict.lookupOr("relaxation", 0.3));
    p.epsilon = float(dict.lookupOr("epsilon", 1e-3)) * bulkSum(liquid);
    p.selfGradient = dict.lookupOr("selfGradient", true);
    p.unilateral = dict.lookupOr("unilateral", true);
    const auto refuse = [&](const std::string& key, bool wrong, const std::string& expected)
    {
        if (wrong) throw FatalInputError(dict.where(key), "Entry '" + key + "' is out of range", expected);
    };
    refuse("maxIterations", p.maxIterations < 1, "1 or more");
    refuse("minIterations", p.minIterations < 0 || p.minIterations > p.maxIterations, "0 to maxIterations");
    refuse("tolerance", !(p.tolerance >= 0), "0 (every iteration is made) or more");
    refuse("relaxation", !(p.relaxation > 0 && p.relaxation < 2), "more than 0 and less than 2");
    refuse("epsilon", !(p.epsilon >= 0), "0 or more");
    return p;
}

}

Pbf::Pbf(const Dictionary& dict, Liquid& liquid)
:
    parameters_(readParameters(dict, liquid)),
    multiplier_(liquid.fields().require<float>({.name = "multiplier", .dimensions = dimensions::none, .sorted = false, .exchanged = true}))
{}

double Pbf::averageError(const Liquid& liquid)
{
    return reduce(liquid.owned(), Compression<Sum>{liquid.density.span()}, scratch_).value / liquid.owned();
}

bool Pbf::violated(Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    if (iterations_ >= parameters_.maxIterations || liquid.owned() == 0) return false;
    if (keepsPotential_ && iterations_ == 0)
    {
        potential_.resizeDiscarding(liquid.all());
        potential_.setZero();
    }
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            const float V = liquid.particleVolume();
            forEach(liquid.owned(), Multiplier<Kernel>
            {
                W, V, V / liquid.latticeSum(), parameters_.epsilon, parameters_.selfGradient, parameters_.unilateral,
                liquid.predicted.span(), near.view(), walls.view(), liquid.density.span(), multiplier_.span()
            });
        },
        liquid.kernel()
    );
    if (iterations_ < parameters_.minIterations || parameters_.tolerance == 0) return true;
    return averageError(liquid) > parameters_.tolerance;
}

void Pbf::correct(Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    ++iterations_;
    corrected_.resizeDiscarding(liquid.all());
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            forEach(liquid.owned(), Correction<Kernel>
            {
                W, liquid.particleVolume(), parameters_.relaxation, liquid.predicted.span(), near.view(), walls.view(),
                multiplier_.span(), corrected_.span()
            });
        },
        liquid.kernel()
    );
    liquid.predicted.swap(corrected_);
    if (keepsPotential_)
    {
        forEach(liquid.owned(), AddPotential{parameters_.relaxation, multiplier_.span(), potential_.span()});
    }
}

const Buffer<float>* Pbf::keepPotential()
{
    keepsPotential_ = true;
    return &potential_;
}

}
