// No force on the whole liquid.

#include "models/bodyForce/BodyForce.H"

namespace shizuku
{

namespace
{

class NoBodyForce : public BodyForce
{
public:
    NoBodyForce(const std::filesystem::path&, const Liquid&) {}
    void apply(Liquid&, scalar) override {}
};

const BodyForceTable::Add<NoBodyForce> registered{"none"};

}

}
