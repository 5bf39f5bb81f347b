// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/CheckedParts.H"

#include "core/messages/Error.H"
#include "parallel/AllParts.H"
#include "parallel/CallPlace.H"

#include <algorithm>
#include <sstream>

namespace shizuku
{

std::vector<Bytes> CheckedParts::exchange(std::vector<Bytes> to) const
{
    check(Kind::exchange, 0);
    return parts_.exchange(std::move(to));
}

void CheckedParts::exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const
{
    check(Kind::pieces, 0);
    parts_.exchange(sent, received);
}

void CheckedParts::begin(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const
{
    check(Kind::begin, 0);
    parts_.begin(sent, received);
}

void CheckedParts::gather(const void* own, std::size_t size, void* all) const
{
    check(Kind::gather, size);
    parts_.gather(own, size, all);
}

void CheckedParts::finish() const
{
    check(Kind::finish, 0);
}

void CheckedParts::check(Kind kind, std::size_t size) const
{
    const CallPlace place = CallPlace::here();
    const Tag own{++calls_, kind, size, kind == Kind::finish ? 0 : place.hash()};
    const std::vector<Tag> tags = parts_.gather(own);
    if (std::all_of(tags.begin(), tags.end(), [&](const Tag& tag) { return tag == tags.front(); })) return;
    const std::string text = textOf(own) + (kind == Kind::finish ? "" : place.text());
    const Bytes bytes = bytesOf(std::vector<char>(text.begin(), text.end()));
    std::ostringstream message;
    message << "The parts of the liquid made different calls, call " << calls_ << " of each, where all have to make the same:";
    int part = 0;
    for (const Bytes& given : parts_.exchange(std::vector<Bytes>(parts(), bytes)))
    {
        std::vector<char> each;
        appendTo(each, given);
        message << "\n    part " << part++ << ": " << std::string(each.begin(), each.end());
    }
    throw FatalError(message.str());
}

std::string CheckedParts::textOf(const Tag& tag)
{
    switch (tag.kind)
    {
        case Kind::exchange: return "exchange() of messages, in";
        case Kind::pieces: return "exchange() of pieces, in";
        case Kind::begin: return "begin() of an exchange, in";
        case Kind::gather: return "gather() of " + std::to_string(tag.size) + " bytes, in";
        case Kind::finish: break;
    }
    return "has come to its end";
}

}
