// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/KeywordPattern.H"

#include "core/dictionary/InputLimits.H"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <regex.h>

namespace shizuku
{

struct KeywordPattern::Automaton
{
    explicit Automaton(const std::string& text) : status(regcomp(&expression, text.c_str(), REG_EXTENDED | REG_NOSUB)) {}
    ~Automaton() { if (status == 0) regfree(&expression); }
    Automaton(const Automaton&) = delete;
    Automaton& operator=(const Automaton&) = delete;

    regex_t expression;
    int status;
};

namespace
{

std::string shortened(const std::string& text)
{
    constexpr std::size_t shown = 60;
    return text.size() <= shown ? text : text.substr(0, shown) + "...";
}

// Walks over an expression and adds up how large it is with its repetitions written out.
class PatternExtent
{
public:
    PatternExtent(const std::string& text, const SourceLocation& where) : text_(text), where_(where)
    {
        if (text.size() > inputLimits::patternText)
        {
            fail("is " + std::to_string(text.size()) + " characters long",
                "at most " + std::to_string(inputLimits::patternText) + " characters");
        }
        for (std::size_t i = 0; i < text_.size(); ++i) i = take(i);
        if (open_.size() > 1) malformed();
        if (open_.front().size > inputLimits::patternSize)
        {
            fail("is too large with its repetitions written out",
                "at most " + std::to_string(inputLimits::patternSize) + " characters, 'a{9}' being nine of them");
        }
    }

    [[noreturn]] void malformed() const { fail("is not a regular expression", form); }

private:
    static constexpr const char* form = "a POSIX extended regular expression, e.g. \"(U|k).*\"";

    struct Group
    {
        double size = 0;
        double last = 0;        // of what a repetition behind it would repeat
    };

    [[noreturn]] void fail(const std::string& what, const std::string& expected) const
    {
        throw FatalInputError(where_, "Keyword \"" + shortened(text_) + "\" " + what, expected);
    }

    void add(double size)
    {
        open_.back().size += size;
        open_.back().last = size;
    }

    void repeat(double times)
    {
        // Each on top of another doubles the work of compiling it.
        if (repeated_) fail("repeats what is repeated already", "one of * + ? {..} behind what it repeats");
        repeated_ = true;
        open_.back().size += open_.back().last*(times - 1);
        open_.back().last *= times;
    }

    // The last byte of what starts at i.
    std::size_t take(std::size_t i)
    {
        repeated_ = repeated_ && std::string("*+?{").find(text_[i]) != std::string::npos;
        switch (text_[i])
        {
            case '\\': return takeEscaped(i);
            case '[': add(1); return endOfSet(i);
            case '(': open(); break;
            case ')': close(); break;
            case '+': repeat(2); break;
            case '{': return takeBounds(i);
            case '*': case '?': repeat(1); break;
            case '|': break;
            default: add(1);
        }
        return i;
    }

    std::size_t takeEscaped(std::size_t i)
    {
        if (i + 1 == text_.size()) malformed();
        if (text_[i + 1] >= '0' && text_[i + 1] <= '9')
        {
            fail("refers back to one of its groups", "a POSIX extended regular expression, which has no back-references");
        }
        add(1);
        return i + 1;
    }

    void open()
    {
        if (open_.size() > inputLimits::patternNesting)
        {
            fail("nests its brackets too deep", "at most " + std::to_string(inputLimits::patternNesting) + " levels");
        }
        open_.emplace_back();
    }

    void close()
    {
        if (open_.size() == 1) malformed();
        const double size = open_.back().size + 1;
        open_.pop_back();
        add(size);
    }

    std::size_t endOfSet(std::size_t i) const
    {
        ++i;
        if (i < text_.size() && text_[i] == '^') ++i;
        if (i < text_.size() && text_[i] == ']') ++i;
        for (; i < text_.size() && text_[i] != ']'; ++i)
        {
            const bool named = text_[i] == '[' && i + 1 < text_.size() && std::string(":.=").find(text_[i + 1]) != std::string::npos;
            if (!named) continue;
            const std::size_t end = text_.find(std::string(1, text_[i + 1]) + ']', i + 2);
            if (end == std::string::npos) malformed();
            i = end + 1;
        }
        if (i == text_.size()) malformed();
        return i;
    }

    // {n}, {n,} or {n,m}
    std::size_t takeBounds(std::size_t i)
    {
        const std::size_t end = text_.find('}', i);
        if (end == std::string::npos) malformed();
        double most = 0;
        for (std::size_t at = i + 1; at < end; at = std::min(text_.find(',', at), end) + 1)
        {
            most = std::max(most, std::strtod(text_.c_str() + at, nullptr));
        }
        repeat(most + 1);
        return end;
    }

    const std::string& text_;
    const SourceLocation& where_;
    std::vector<Group> open_{1};
    bool repeated_ = false;     // by what stands before
};

}

KeywordPattern::KeywordPattern(const std::string& text, const SourceLocation& where)
{
    const PatternExtent extent(text, where);
    if (Automaton(text).status != 0) extent.malformed();        // alone: "a)(b" shall not be made whole by what is put around
    automaton_ = std::make_shared<Automaton>("^(" + text + ")$");
    if (automaton_->status != 0) extent.malformed();
}

bool KeywordPattern::matches(const std::string& word) const
{
    return regexec(&automaton_->expression, word.c_str(), 0, nullptr, 0) == 0;
}

}
