# Paths below src/.
set(SHIZUKU_GEOMETRY_SOURCES
    geometry/AnalyticSurface.C
    geometry/ContactAngle.C
    geometry/MeshTopology.C
    geometry/PlaneFit.C
    geometry/PlyFile.C
    geometry/PointsInside.C
    geometry/SphereFit.C
    geometry/TriangleMesh.C
    geometry/Vector3.C
)
