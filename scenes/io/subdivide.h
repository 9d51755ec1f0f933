#pragma once

#include "scenes/core/triangle_mesh.h"

namespace rayshoot {

/// How a closed mesh is refined: Loop's rule makes four triangles of one, Kobbelt's square root of 3 makes three.
enum class SubdivisionRule { loop, sqrt3 };

/// The closed mesh refined once by OpenMesh. Throws InputError where the mesh is not manifold.
TriangleMesh subdivided(const TriangleMesh& mesh, SubdivisionRule rule);

}  // namespace rayshoot
