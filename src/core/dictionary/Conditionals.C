// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Conditionals.H"

#include "core/dictionary/InputLimits.H"

#include <algorithm>

namespace shizuku
{

bool Conditionals::isConditional(const Tree& statement)
{
    const NodeData& data = statement.data();
    if (data.kind != NodeKind::directive) return false;
    return data.text == "if" || data.text == "ifeq" || data.text == "else" || data.text == "endif";
}

bool Conditionals::active() const
{
    return std::all_of(open_.begin(), open_.end(), [](const Branch& branch) { return branch.taken; });
}

void Conditionals::step(const Tree& directive, const std::function<bool()>& condition)
{
    const NodeData& data = directive.data();
    if (data.text == "if" || data.text == "ifeq")
    {
        if (open_.size() == inputLimits::conditionals)
        {
            throw FatalInputError(data.where, "#if are nested too deep",
                "at most " + std::to_string(inputLimits::conditionals) + " levels");
        }
        const bool reached = active();
        const bool taken = reached && condition();
        open_.push_back({data.where, taken, reached && !taken, false});
        return;
    }
    if (open_.empty())
    {
        throw FatalInputError(data.where, "#" + data.text + " belongs to no #if", "#if or #ifeq before it, within the "
            "same { }");
    }
    Branch& branch = open_.back();
    if (data.text == "endif")
    {
        open_.pop_back();
        return;
    }
    if (branch.turned)
    {
        throw FatalInputError(data.where, "A second #else for the #if of line " + std::to_string(branch.where.line),
            "#endif");
    }
    branch.turned = true;
    branch.taken = branch.possible;
}

void Conditionals::requireClosed() const
{
    if (open_.empty()) return;
    throw FatalInputError(open_.back().where, "This #if has no end", "#endif within the same { }");
}

}
