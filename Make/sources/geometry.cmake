# Paths below src/.
set(SHIZUKU_GEOMETRY_SOURCES
    geometry/AnalyticSurface.C
    geometry/Vector3.C
)
