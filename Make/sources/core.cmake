# Paths below src/.
set(SHIZUKU_CORE_SOURCES
    core/dictionary/BalanceCheck.C
    core/dictionary/Dictionary.C
    core/dictionary/DictionaryExpansion.C
    core/dictionary/DictionaryGrammar.C
    core/dictionary/DictionaryLookup.C
    core/dictionary/DictionaryTree.C
    core/dictionary/DictionaryUsage.C
    core/dictionary/Dimensions.C
    core/dictionary/ValueReader.C
    core/messages/Error.C
)
