// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/ModelList.H"

#include "functionObjects/FunctionObject.H"
#include "models/Models.H"

#include <iomanip>
#include <sstream>

namespace shizuku
{

namespace
{

std::string paragraph(const std::string& heading, const std::map<std::string, std::string>& models)
{
    constexpr int column = 24;              // where what it is begins
    std::ostringstream text;
    text << heading << "\n";
    for (const auto& [word, summary] : models) text << "    " << std::left << std::setw(column) << word << summary << "\n";
    return text.str();
}

}

std::string modelList()
{
    std::string text;
    for (const ModelKind& kind : modelKinds()) text += paragraph(kind.keyword, kind.models);
    return text + paragraph("functions (system/controlDict)", FunctionObjectTable::summaries());
}

}
