// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/AllParts.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <exception>

namespace shizuku
{

void inAllParts(const Communicator& parts, const std::function<void()>& work)
{
    std::exception_ptr failure;
    std::string reason;
    try
    {
        work();
    }
    catch (const std::exception& error)
    {
        failure = std::current_exception();
        reason = error.what();
    }
    if (!parts.any(bool(failure))) return;
    const Bytes own = bytesOf(std::vector<char>(reason.begin(), reason.end()));
    const std::vector<Bytes> reasons = parts.exchange(std::vector<Bytes>(parts.parts(), own));
    if (failure) std::rethrow_exception(failure);
    int part = 0;
    while (reasons[part].empty()) ++part;
    std::vector<char> text;
    appendTo(text, reasons[part]);
    throw FatalError("Part " + std::to_string(part) + " of " + std::to_string(parts.parts()) + ": " + std::string(text.begin(), text.end()));
}

std::pair<std::size_t, std::size_t> shareOf(const Communicator& parts, std::size_t n)
{
    const auto begin = [&](int part) { return std::size_t(part) * (n / parts.parts()) + std::min(std::size_t(part), n % parts.parts()); };
    return {begin(parts.part()), begin(parts.part() + 1)};
}

std::vector<std::string> gatherTexts(const Communicator& parts, const std::string& own)
{
    std::vector<Bytes> to(parts.parts());
    to[0] = bytesOf(std::vector<char>(own.begin(), own.end()));
    std::vector<std::string> texts;
    for (const Bytes& bytes : parts.exchange(std::move(to)))
    {
        std::vector<char> text;
        appendTo(text, bytes);
        texts.emplace_back(text.begin(), text.end());
    }
    if (parts.part() > 0) texts.clear();
    return texts;
}

}
