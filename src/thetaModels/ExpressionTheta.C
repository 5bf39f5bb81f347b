// SPDX-License-Identifier: GPL-3.0-or-later
// type expression; theta "90 + $swing*sin(2*pi*x/$period)"; swing 30; period 1e-3;
// Degrees, a formula of x, y and z in metres with the arithmetic of #calc (see core/dictionary/CalcExpression.H); $name
// is an entry beside it.

#include "core/dictionary/CalcExpression.H"
#include "thetaModels/ThetaModel.H"

#include <sstream>

namespace shizuku
{

class ExpressionTheta : public ThetaModel
{
public:
    ExpressionTheta(const Dictionary& dict, const std::filesystem::path&)
    :
        text_(dict.lookup<std::string>("theta")), where_(dict.where("theta")),
        formula_(text_, where_, [&dict](const std::string& name) { return dict.lookup<double>(name); }, {"x", "y", "z"})
    {}

    double theta(const Vector3& x) const override
    {
        const double value = formula_({x.x, x.y, x.z});
        if (value >= 0 && value <= 180) return value;
        std::ostringstream found;
        found << "The contact angle is " << value << " at " << str(x) << " m, by the expression \"" << text_ << "\"";
        throw FatalInputError(where_, found.str(), "degrees from 0 to 180; min(max(..., 0), 180) cuts off");
    }

private:
    std::string text_;
    SourceLocation where_;
    CalcExpression formula_;
};

static const ThetaModelTable::Add<ExpressionTheta> registered{"expression"};

}
