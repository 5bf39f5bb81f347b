// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/CalcExpression.H"

#include "core/angles/Degrees.H"
#include "core/dictionary/InputLimits.H"
#include "core/dictionary/TextCharacters.H"

#include <boost/spirit/home/x3.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string_view>
#include <vector>

namespace shizuku
{

namespace
{

namespace x3 = boost::spirit::x3;
using x3::_attr;
using x3::_val;

// A parsed expression is a function of the variables' values, so that ?: && || if() evaluate only what they need.
using Values = const std::vector<double>&;
using Term = std::function<double(Values)>;
using Terms = std::vector<Term>;

struct Evaluation
{
    std::string text;
    SourceLocation where;
    MacroValue macro;
    std::vector<std::string> variables;

    [[noreturn]] void fail(const std::string& what, const std::string& expected = "") const
    {
        throw FatalInputError(where, what + " in the expression \"" + text + "\"", expected);
    }
};

struct EvaluationTag;

template<class Context>
const Evaluation& evaluationOf(const Context& context)
{
    return x3::get<EvaluationTag>(context).get();
}

// ---- Functions

struct Function
{
    std::size_t arguments;
    std::function<double(const Terms&, Values)> value;
    bool mayHaveNone = false;
};

Function unary(double (*f)(double))
{
    return {1, [f](const Terms& x, Values v) { return f(x[0](v)); }};
}

Function binary(double (*f)(double, double))
{
    return {2, [f](const Terms& x, Values v) { return f(x[0](v), x[1](v)); }};
}

// f(x), and f() for f(1): the factor of a conversion of units, as OpenFOAM writes it too.
Function conversion(double (*f)(double))
{
    return {1, [f](const Terms& x, Values v) { return f(x.empty() ? 1 : x[0](v)); }, true};
}

double chosen(const Terms& x, Values v)
{
    return x[0](v) != 0 ? x[1](v) : x[2](v);
}

const std::map<std::string, Function>& functions()
{
    static const std::map<std::string, Function> table
    {
        {"abs", unary(std::fabs)}, {"mag", unary(std::fabs)}, {"sqrt", unary(std::sqrt)},
        {"sinh", unary(std::sinh)}, {"cosh", unary(std::cosh)}, {"tanh", unary(std::tanh)},
        {"log10", unary(std::log10)},
        {"sqr", unary([](double x) { return x*x; })}, {"exp", unary(std::exp)}, {"log", unary(std::log)},
        {"sin", unary(std::sin)}, {"cos", unary(std::cos)}, {"tan", unary(std::tan)},
        {"asin", unary(std::asin)}, {"acos", unary(std::acos)}, {"atan", unary(std::atan)},
        {"floor", unary(std::floor)}, {"ceil", unary(std::ceil)},
        {"degToRad", conversion(radians)}, {"radToDeg", conversion(degrees)},
        {"asinh", unary(std::asinh)}, {"acosh", unary(std::acosh)}, {"atanh", unary(std::atanh)},
        {"cbrt", unary(std::cbrt)}, {"erf", unary(std::erf)}, {"round", unary(std::round)},
        {"pow3", unary([](double x) { return x*x*x; })}, {"sign", unary([](double x) { return x >= 0 ? 1.0 : -1.0; })},
        {"atan2", binary(std::atan2)}, {"hypot", binary(std::hypot)}, {"pow", binary(std::pow)},
        {"min", binary(std::fmin)}, {"max", binary(std::fmax)},
        {"if", {3, chosen}},
        {"pi", {0, [](const Terms&, Values) { return std::numbers::pi; }}}
    };
    return table;
}

Term call(const Evaluation& evaluation, const std::string& name, const Terms& arguments)
{
    const auto found = functions().find(name);
    if (found == functions().end())
    {
        std::vector<std::string> names = evaluation.variables;
        for (const auto& [word, function] : functions()) names.push_back(word);
        throw FatalInputError
        (
            evaluation.where, "Unknown name '" + name + "' in the expression \"" + evaluation.text + "\"",
            "one of the names below, or $" + name + " for an entry", names, name
        );
    }
    const Function& function = found->second;
    if (arguments.size() != function.arguments && !(function.mayHaveNone && arguments.empty()))
    {
        evaluation.fail
        (
            "'" + name + "' has " + std::to_string(arguments.size()) + " arguments",
            std::to_string(function.arguments) + " arguments"
        );
    }
    return [&function, arguments](Values v) { return function.value(arguments, v); };
}

// ---- Semantic actions

// _val := operation(_val, _attr)
template<class Operation>
auto combine(Operation operation)
{
    return [operation](auto& context)
    {
        const Evaluation& evaluation = evaluationOf(context);
        _val(context) = [operation, &evaluation, a = std::move(_val(context)), b = std::move(_attr(context))](Values v)
        {
            return operation(a, b, v, evaluation);
        };
    };
}

template<class Operation>
auto applied(Operation operation)
{
    return [operation](auto& context)
    {
        _val(context) = [operation, a = std::move(_attr(context))](Values v) { return double(operation(a(v))); };
    };
}

// An operation on two values that are both needed.
template<class Operation>
auto values(Operation operation)
{
    return combine([operation](const Term& a, const Term& b, Values v, const Evaluation&)
    {
        return double(operation(a(v), b(v)));
    });
}

template<class Operation>
auto division(Operation operation)
{
    return combine([operation](const Term& a, const Term& b, Values v, const Evaluation& evaluation)
    {
        const double divisor = b(v);
        if (divisor == 0) evaluation.fail("Division by zero");
        return operation(a(v), divisor);
    });
}

const auto pass = [](auto& context) { _val(context) = std::move(_attr(context)); };
const auto constant = [](auto& context) { _val(context) = [value = double(_attr(context))](Values) { return value; }; };
const auto add = [](auto& context) { _val(context).push_back(std::move(_attr(context))); };
const auto addName = [](auto& context) { _val(context).assign(_attr(context).begin(), _attr(context).end()); };

const auto macroValue = [](auto& context)
{
    const Evaluation& evaluation = evaluationOf(context);
    _val(context) = [value = evaluation.macro(_attr(context))](Values) { return value; };
};

const auto functionCall = [](auto& context)
{
    using boost::fusion::at_c;
    _val(context) = call(evaluationOf(context), at_c<0>(_attr(context)), at_c<1>(_attr(context)));
};

const auto variableOrConstant = [](auto& context)
{
    const Evaluation& evaluation = evaluationOf(context);
    const auto& names = evaluation.variables;
    const auto variable = std::find(names.begin(), names.end(), _attr(context));
    if (variable == names.end()) _val(context) = call(evaluation, _attr(context), {});
    else _val(context) = [i = std::size_t(variable - names.begin())](Values v) { return v[i]; };
};

// ---- Grammar, from the loosest binding to the tightest

const x3::rule<class ChoiceTag, Term> choice = "expression";
const x3::rule<class EitherTag, Term> either = "||";
const x3::rule<class BothTag, Term> both = "&&";
const x3::rule<class EqualityTag, Term> equality = "== or !=";
const x3::rule<class OrderTag, Term> order = "comparison";
const x3::rule<class SumTag, Term> sum = "sum";
const x3::rule<class ProductTag, Term> product = "product";
const x3::rule<class SignTag, Term> sign = "signed value";
const x3::rule<class PowerTag, Term> power = "power";
const x3::rule<class PrimaryTag, Term> primary = "value";
const x3::rule<class ArgumentsTag, Terms> arguments = "arguments";
const x3::rule<class NameTag, std::string> name = "name";
const x3::rule<class MacroTag, std::string> macro = "macro";
const x3::rule<class BranchesTag, Terms> branches = "? :";

const auto pickBranch = [](auto& context)
{
    _val(context) = [condition = std::move(_val(context)), branch = std::move(_attr(context))](Values v)
    {
        return condition(v) != 0 ? branch[0](v) : branch[1](v);
    };
};

const auto eitherTerm = combine([](const Term& a, const Term& b, Values v, const Evaluation&)
{
    return double(a(v) || b(v));
});
const auto bothTerms = combine([](const Term& a, const Term& b, Values v, const Evaluation&)
{
    return double(a(v) && b(v));
});
const auto remainder = division([](double a, double b) { return std::fmod(a, b); });
const auto raise = values([](double a, double b) { return std::pow(a, b); });

const auto branches_def = '?' > choice[add] > ':' > choice[add];
const auto choice_def = either[pass] >> -branches[pickBranch];
const auto either_def = both[pass] >> *("||" > both[eitherTerm]);
const auto both_def = equality[pass] >> *("&&" > equality[bothTerms]);
const auto equality_def = order[pass]
    >> *(("==" > order[values(std::equal_to<>())]) | ("!=" > order[values(std::not_equal_to<>())]));
const auto order_def = sum[pass]
    >> *(("<=" > sum[values(std::less_equal<>())]) | (">=" > sum[values(std::greater_equal<>())])
       | ('<' > sum[values(std::less<>())]) | ('>' > sum[values(std::greater<>())]));
const auto sum_def = product[pass]
    >> *(('+' > product[values(std::plus<>())]) | ('-' > product[values(std::minus<>())]));
const auto product_def = sign[pass]
    >> *(('*' > sign[values(std::multiplies<>())]) | ('/' > sign[division(std::divides<>())])
        | ('%' > sign[remainder]));
const auto sign_def = ('-' > sign[applied(std::negate<>())]) | ('+' > sign[pass])
    | ('!' > sign[applied(std::logical_not<>())]) | power[pass];
const auto power_def = primary[pass] >> -('^' > sign[raise]);
const auto primary_def = x3::double_[constant] | ('(' > choice[pass] > ')') | macro[macroValue]
    | (name >> arguments)[functionCall] | name[variableOrConstant];
const auto blank = textCharacters::space | "//" >> *(x3::char_ - x3::eol) | "/*" >> *(x3::char_ - "*/") >> "*/";
const auto arguments_def = '(' >> -(choice[add] % ',') > ')';
const auto name_def = x3::lexeme[x3::raw[textCharacters::alpha >> *(textCharacters::alnum | '_')][addName]];
const auto macro_def = x3::lexeme['$' > -x3::lit("<scalar>") > ('{' >> x3::raw[+(x3::char_ - '}')][addName] >> '}'
    | x3::raw[+(textCharacters::alnum | x3::char_("_.:"))][addName])];

BOOST_SPIRIT_DEFINE(choice, either, both, equality, order, sum, product, sign, power, primary, arguments, name,
    macro, branches)

}

namespace
{

const char* const aValue = "a number, a name, a function or '('";

// What may stand where the parser stopped. `awaited`: the parser's name for it, which is a C++ type for all that leads to a value.
std::string expectedBehind(const std::string& before, const std::string& awaited)
{
    if (before.ends_with('$')) return "the name of an entry";
    if (awaited == "eoi") return "an operator or the end";
    return awaited.starts_with('\'') ? "an operator or " + awaited : aValue;
}

}

namespace
{

// The parser and the value of an expression take stack for each bracket and each operator.
void checkExtent(const Evaluation& evaluation)
{
    const auto refuse = [&](const std::string& what, std::size_t limit)
    {
        throw FatalInputError(evaluation.where, "The expression \"" + evaluation.text.substr(0, 60) + "...\" " + what,
            "at most " + std::to_string(limit));
    };
    const std::string& text = evaluation.text;
    if (text.size() > inputLimits::expressionText)
    {
        refuse("has " + std::to_string(text.size()) + " characters", inputLimits::expressionText);
    }
    std::size_t operators = 0, choices = 0, depth = 0;
    for (const char c : text)
    {
        if (std::string_view("+-*/%^!<>=&|").find(c) != std::string_view::npos) ++operators;
        if (c == '?') ++choices;
        if (c == '(') ++depth;
        if (c == ')' && depth > 0) --depth;
        if (depth + choices > inputLimits::expressionNesting)
        {
            refuse("nests brackets or choices too deep", inputLimits::expressionNesting);
        }
    }
    if (operators > inputLimits::expressionOperators)
    {
        refuse("has " + std::to_string(operators) + " operators", inputLimits::expressionOperators);
    }
}

}

struct CalcExpression::Parsed
{
    Evaluation evaluation;      // the term refers to it
    Term term;
};

CalcExpression::CalcExpression
(
    const std::string& text, const SourceLocation& where, const MacroValue& macro,
    const std::vector<std::string>& variables
)
{
    const auto parsed = std::make_shared<Parsed>(Parsed{{text, where, macro, variables}, {}});
    const Evaluation& evaluation = parsed->evaluation;
    checkExtent(evaluation);
    auto first = text.begin();
    try
    {
        const auto parser = x3::with<EvaluationTag>(std::cref(evaluation))[choice > x3::eoi];
        x3::phrase_parse(first, text.end(), parser, blank, parsed->term);
    }
    catch (const x3::expectation_failure<std::string::const_iterator>& failure)
    {
        const auto isSpace = [](unsigned char c) { return std::isspace(c); };
        const std::string rest(std::find_if_not(failure.where(), text.end(), isSpace), text.end());
        evaluation.fail
        (
            rest.empty() ? "The end comes too early" : "Unexpected '" + rest + "'",
            expectedBehind({text.begin(), failure.where()}, failure.which())
        );
    }
    if (!parsed->term) evaluation.fail("No value", aValue);
    parsed_ = parsed;
}

double CalcExpression::operator()(const std::vector<double>& values) const
{
    const double result = parsed_->term(values);
    if (!std::isfinite(result)) parsed_->evaluation.fail("The result is not finite");
    return result;
}

std::string numberText(double value)
{
    char buffer[64];
    if (value == std::trunc(value) && std::fabs(value) < 1e15)
    {
        std::snprintf(buffer, sizeof buffer, "%.0f", value);
        return buffer;
    }
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return std::string(buffer, end);
}

}
