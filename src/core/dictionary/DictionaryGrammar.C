// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/DictionaryGrammar.H"
#include "core/dictionary/BalanceCheck.H"
#include "core/dictionary/TextCharacters.H"

#include <boost/spirit/home/x3.hpp>

#include <algorithm>
#include <cctype>

namespace shizuku
{

namespace
{

namespace x3 = boost::spirit::x3;
using x3::_attr;
using x3::_val;
using x3::char_;
using x3::eol;
using x3::lexeme;
using x3::lit;
using x3::raw;
using Iterator = std::string::const_iterator;

struct SourceTag;   // key of the SourceText in the parser's context

template<class Context>
const SourceText& sourceOf(const Context& context)
{
    return x3::get<SourceTag>(context).get();
}

template<class Context>
std::size_t offsetOf(const Iterator& position, const Context& context)
{
    return position - sourceOf(context).text().begin();
}

// ---- Errors of rules

// The character at the place of an error, as it is shown to the user.
template<class Context>
std::string shown(const Iterator& position, const Context& context)
{
    const std::string& text = sourceOf(context).text();
    if (position == text.end()) return "the end of the file";
    return std::string("'") + *position + "' at line "
        + std::to_string(sourceOf(context).line(offsetOf(position, context)));
}

struct StatementsTag
{
    template<class Context>
    x3::error_handler_result on_error
    (
        Iterator&, const Iterator&, const x3::expectation_failure<Iterator>& failure, const Context& context
    )
    {
        throw FatalInputError
        (
            sourceOf(context).at(offsetOf(failure.where(), context)),
            "A keyword was expected where " + shown(failure.where(), context) + " stands",
            "keyword value; or keyword { ... }"
        );
    }
};

struct EntryTag
{
    template<class Context>
    x3::error_handler_result on_error
    (
        Iterator& first, const Iterator& last, const x3::expectation_failure<Iterator>& failure, const Context& context
    )
    {
        Iterator start = first;
        x3::skip_over(start, last, context);
        const Iterator end = std::find_if(start, last, [](unsigned char c) { return std::isspace(c) || c == ';'; });
        throw FatalInputError
        (
            sourceOf(context).at(offsetOf(start, context)),
            "The entry '" + std::string(start, end) + "' has no end",
            "a ';' before " + shown(failure.where(), context)
        );
    }
};

struct ListTag
{
    template<class Context>
    x3::error_handler_result on_error
    (
        Iterator&, const Iterator&, const x3::expectation_failure<Iterator>& failure, const Context& context
    )
    {
        throw FatalInputError
        (
            sourceOf(context).at(offsetOf(failure.where(), context)),
            "Unexpected " + shown(failure.where(), context) + " in a list", "an item or the closing bracket"
        );
    }
};

// ---- Semantic actions

// The node learns its span, file and line; parser: all of its text.
const auto located = [](auto parser)
{
    return raw[parser][([](auto& context)
    {
        NodeData& data = _val(context).data();
        data.span = {offsetOf(_attr(context).begin(), context), offsetOf(_attr(context).end(), context)};
        data.where = sourceOf(context).at(data.span.begin);
    })];
};

// The token's kind and its text, from raw[].
template<NodeKind kind>
const auto token = [](auto& context)
{
    NodeData& data = _val(context).data();
    data.kind = kind;
    data.text.assign(_attr(context).begin(), _attr(context).end());
};

template<NodeKind kind>
const auto mark = [](auto& context) { _val(context).data().kind = kind; };

const auto setText = [](auto& context)
{
    _val(context).data().text.assign(_attr(context).begin(), _attr(context).end());
};

// \" is a quote, a backslash before the end of the line joins the lines, other backslashes stay.
const auto unescaped = [](auto& context)
{
    NodeData& data = _val(context).data();
    data.kind = NodeKind::string;
    for (auto c = _attr(context).begin(); c != _attr(context).end(); ++c)
    {
        const auto next = std::next(c);
        if (*c != '\\' || next == _attr(context).end()) data.text += *c;
        else if (*next == '"') data.text += *++c;
        else if (*next == '\n') ++c;
        else if (*next == '\r') c += 2;
        else { data.text += *c; data.text += *++c; }
    }
};

const auto addItem = [](auto& context) { _val(context).push_back({"", std::move(_attr(context))}); };

const auto addStatement = [](auto& context)
{
    Tree& statement = _attr(context);
    const NodeKind kind = statement.data().kind;
    const bool named = kind == NodeKind::entry || kind == NodeKind::dictionary;
    std::string key = named ? statement.data().text : "";
    _val(context).push_back({std::move(key), std::move(statement)});
};

// The statement takes the keyword's text and becomes an entry until a body is found.
const auto setKeyword = [](auto& context)
{
    NodeData& data = _val(context).data();
    const NodeData& keyword = _attr(context).data();
    data.kind = NodeKind::entry;
    data.text = keyword.text;
    data.style = keyword.kind == NodeKind::string ? KeywordStyle::pattern
               : keyword.kind == NodeKind::macro ? KeywordStyle::macro : KeywordStyle::word;
    data.value = {keyword.span.end, keyword.span.end};
};

const auto addValueItem = [](auto& context)
{
    NodeData& data = _val(context).data();
    const TextSpan item = _attr(context).data().span;
    if (_val(context).empty()) data.value.begin = item.begin;
    data.value.end = item.end;
    _val(context).push_back({"", std::move(_attr(context))});
};

const auto setBody = [](auto& context)
{
    NodeData& data = _val(context).data();
    Tree& body = _attr(context);
    data.kind = NodeKind::dictionary;
    data.value = {body.data().span.begin + 1, body.data().span.end - 1};
    _val(context).swap(body);
    std::swap(_val(context).data(), body.data());
};

// ---- Tokens

// Text from a bracket to its partner, whatever stands between: brackets in quotes and comments count as well here, which
// nobody has counted before, so it takes no recursion.
class BalancedText : public x3::parser<BalancedText>
{
public:
    using attribute_type = x3::unused_type;
    static constexpr bool has_attribute = false;

    constexpr BalancedText(char open, char close) : open_(open), close_(close) {}

    template<class Context, class RuleContext, class Attribute>
    bool parse(Iterator& first, const Iterator& last, const Context&, RuleContext&, Attribute&) const
    {
        if (first == last || *first != open_) return false;
        std::size_t depth = 0;
        for (Iterator at = first; at != last; ++at)
        {
            if (*at == open_) ++depth;
            if (*at != close_ || --depth != 0) continue;
            first = std::next(at);
            return true;
        }
        return false;
    }

private:
    char open_, close_;
};

const auto byteOrderMark = lit("\xEF\xBB\xBF");
const auto skipper = textCharacters::space | byteOrderMark
    | "//" >> *(char_ - eol)
    | "/*" >> *(char_ - "*/") >> "*/";

const auto wordChar = (char_ - (textCharacters::space | char_("\"';{}()[]/"))) | (char_('/') >> !char_("/*"));
struct GroupTag;
const x3::rule<GroupTag> group = "(..)";        // balanced parentheses within a word
const auto group_def = '(' >> *(group | wordChar) >> ')';
const auto wordText = wordChar >> *(wordChar | group);
const auto numberText = x3::double_ >> !wordChar;

const x3::rule<class NumberTag, Tree> number = "number";
const x3::rule<class WordTag, Tree> word = "word";
const x3::rule<class StringTag, Tree> string = "string";
const x3::rule<class VerbatimTag, Tree> verbatim = "verbatim text";
const x3::rule<class DimensionsTag, Tree> dimensions = "dimensions";
const x3::rule<class MacroTag, Tree> macro = "macro";
const x3::rule<class DirectiveTag, Tree> directive = "directive";
const x3::rule<class CodeTag, Tree> code = "{..}";
constexpr BalancedText nested('{', '}');
constexpr BalancedText arguments('(', ')');                                 // of a function, blanks before and within them
const x3::rule<class FunctionCallTag, Tree> functionCall = "name(..)";

const auto number_def = located(lexeme[raw[numberText][token<NodeKind::number>]]);
const auto word_def = located(lexeme[!char_("#$") >> raw[wordText][token<NodeKind::word>]]);
const auto string_def =
    located(lexeme['"' >> raw[*('\\' >> -lit('\r') >> char_ | (char_ - char_("\"\\\n")))][unescaped] >> '"']);
const auto verbatim_def = located(lexeme["#{" >> raw[*(char_ - "#}")][token<NodeKind::verbatim>] >> "#}"]);
const auto dimensions_def = located(lexeme['[' >> raw[*(char_ - ']')][token<NodeKind::dimensions>] >> ']']);
const auto macro_def = located(lexeme['$' >>
    ('{' >> raw[+(nested | (char_ - char_("{}")))][token<NodeKind::macro>] >> '}'
    | raw[wordText][token<NodeKind::macro>])]);
const auto functionCall_def = located(lexeme[raw[wordText >> -(*textCharacters::space >> arguments)][token<NodeKind::word>]]);
const auto code_def = located(lexeme['{' >> raw[*(nested | (char_ - char_("{}")))][token<NodeKind::verbatim>] >> '}']);

// ---- Values

const x3::rule<ListTag, Tree> list = "list";
const x3::rule<class UniformListTag, Tree> uniformList = "N{..}";
const x3::rule<class ItemTag, Tree> item = "item";
const x3::rule<class PlainItemTag, Tree> plainItem = "item";             // no directive
const x3::rule<class OperandTag, Tree> operand = "operand";               // of #if and #ifeq
const x3::rule<class ValueDirectiveTag, Tree> valueDirective = "directive";
struct BodyTag : StatementsTag {};
const x3::rule<BodyTag, Tree> body = "{ .. }";

struct UniformListTag : ListTag {};
const auto list_def = located(x3::eps[mark<NodeKind::list>]
    >> -lexeme[raw[x3::uint_ >> &lit('(')][setText]] >> '(' > *(item[addItem] | body[addItem]) > ')');
const auto uniformList_def = located(x3::eps[mark<NodeKind::uniformList>]
    >> lexeme[raw[x3::uint_ >> &lit('{')][setText]] >> '{' > *item[addItem] > '}');
const auto directiveName = [](auto name) { return lexeme['#' >> raw[name >> !textCharacters::alnum][token<NodeKind::directive>]]; };
const auto branchName = (lit("ifeq") | "if" | "else" | "endif") >> !textCharacters::alnum;
struct ItemTag {};
const auto passOn = [](auto& context) { _val(context) = std::move(_attr(context)); };
const auto plainItem_def = list[passOn] | uniformList[passOn] | number[passOn] | string[passOn] | verbatim[passOn]
    | dimensions[passOn] | macro[passOn] | word[passOn];
const auto item_def = plainItem[passOn] | directive[passOn];
// A directive's argument is none itself, nor is the condition of #if another #if: what does not fit would be read anew at each of them.
const auto valueDirective_def = located
(
    directiveName(lit("includeFunc") | "includeConstraint" | "includeModel") >> (functionCall[addItem] | plainItem[addItem])
    | lexeme['#' >> !branchName >> raw[+textCharacters::alnum][token<NodeKind::directive>]] >> -(code[addItem] | plainItem[addItem])
);
const auto operand_def = plainItem[passOn] | valueDirective[passOn];
const auto conditional = located
(
    directiveName(lit("ifeq")) >> (list[addItem] | operand[addItem] >> operand[addItem])
    | directiveName(lit("if")) >> operand[addItem]
    | directiveName(lit("else") | "endif")
);
const auto directive_def = conditional | valueDirective[passOn];

// ---- Statements

const x3::rule<StatementsTag, Tree> document = "dictionary";
const x3::rule<EntryTag, Tree> entry = "entry";
const x3::rule<class MacroStatementTag, Tree> macroStatement = "$macro;";
const x3::rule<class LastBodyTag, Tree> lastBody = "{ .. };";

const auto keyword = word[setKeyword] | string[setKeyword] | macro[setKeyword];
const auto statements = *(entry[addStatement] | directive[addStatement] | macroStatement[addStatement] | ';');
// A macro that is the last of its line, or of its dictionary, needs no ';', unless a '{' makes it a keyword.
const auto restOfLine = x3::no_skip[*textCharacters::blank >> -("//" >> *(char_ - eol)) >> (eol | x3::eoi)];
const auto macroStatement_def = macro[passOn] >> ((restOfLine >> !lit('{')) | ';' | &lit('}') | x3::eoi);
// A value may end with a dictionary: div(phi,Yi_h) Gauss multivariateSelection { ... };
const auto lastBody_def = body[passOn] >> &lit(';');
const auto entry_def = located(!(number | macroStatement) >> keyword
    >> (body[setBody] | (x3::eps > *item[addValueItem] > -lastBody[addValueItem] > ';')));
const auto body_def = located('{' > statements > '}');
const auto document_def = located(x3::eps > statements > x3::eoi);
const x3::rule<struct ItemsTag, Tree> items = "value";
struct ItemsTag : ListTag {};
const auto items_def = located(x3::eps[mark<NodeKind::entry>] > *item[addValueItem] > x3::eoi);

BOOST_SPIRIT_DEFINE(group, number, word, string, verbatim, dimensions, macro, functionCall, code)
BOOST_SPIRIT_DEFINE(list, uniformList, plainItem, valueDirective, operand, directive, item, macroStatement, lastBody, entry, body, document, items)

template<class Rule>
Tree parseWith(const Rule& rule, const SourceText& source)
{
    checkBalance(source);
    Tree tree;
    Iterator first = source.text().begin();
    x3::phrase_parse(first, source.text().end(), x3::with<SourceTag>(std::cref(source))[rule], skipper, tree);
    tree.data().where = {source.name(), 1};
    return tree;
}

}

Tree parseSyntax(const SourceText& source)
{
    return parseWith(document, source);
}

Tree parseItems(const SourceText& source)
{
    return parseWith(items, source);
}

}
