# Paths below src/.
set(SHIZUKU_GEOMETRY_SOURCES
    geometry/AnalyticSurface.C
    geometry/ContactAngle.C
    geometry/Drops.C
    geometry/LiquidFiles.C
    geometry/MeshTopology.C
    geometry/PlaneFit.C
    geometry/PlyFile.C
    geometry/PointsInside.C
    geometry/SolidParticles.C
    geometry/SphereFit.C
    geometry/StlFile.C
    geometry/TriangleMesh.C
    geometry/Vector3.C
    geometry/WallPlane.C
)

# Solid particles on surfaces. CGAL.
set(SHIZUKU_SAMPLING_SOURCES
    geometry/sampling/Bell.C
    geometry/sampling/LayerQuality.C
    geometry/sampling/LayerRelaxation.C
    geometry/sampling/PlanarLattice.C
    geometry/sampling/PoissonDisk.C
    geometry/sampling/SurfaceDistance.C
    geometry/sampling/SurfaceFile.C
    geometry/sampling/SurfaceGeometry.C
    geometry/sampling/SurfaceRepair.C
    geometry/sampling/SurfaceSampler.C
)
