#pragma once
// Which items may look different from another viewpoint, by their material. Not part of the folder's public
// face.

#include <vector>

#include "src/core/renderer.h"
#include "src/scene/scene.h"

namespace promenade::render {

/// One entry an instance. An item is view dependent if its material
///  - lets light through (transmission or alpha blending), or
///  - has a clear coat that is not rough (clearcoat * texture at least 0.05, its roughness at most 0.5), or
///  - is metallic (at least 0.5) somewhere and smoother than 0.5 somewhere, or
///  - is smoother than 0.35 somewhere and reflects specularly at all.
/// "Somewhere" is at least 2% of the texels of the texture, so that a few stray texels do not decide.
[[nodiscard]] std::vector<ItemTraits> itemTraits(const Scene& scene);

}  // namespace promenade::render
