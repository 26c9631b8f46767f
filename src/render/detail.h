#pragma once

namespace promenade::render {

/// How exactly textures are to be looked up, by what becomes of the light.
enum class Detail {
  kFull,
  /// It is blurred anyway: the mip level nearest to the footprint is enough, and bumps are flat on average.
  kBlurred,
};

}  // namespace promenade::render
