// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/velocityFilter/VelocityFilter.H"

namespace shizuku
{

std::unique_ptr<VelocityFilter> VelocityFilter::New(const Dictionary& models, Liquid& liquid)
{
    const auto word = models.lookupOr<std::string>("velocityFilter", "none");
    return VelocityFilterTable::New
    (
        "velocityFilter", word, models.where("velocityFilter"), models.subDictOrEmpty(word + "Coeffs"), liquid
    );
}

}
