# Paths below src/.
set(SHIZUKU_CORE_SOURCES
    core/messages/Error.C
)
