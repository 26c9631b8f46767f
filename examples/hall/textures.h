#pragma once
// The hall's building materials as periodic textures. `kMetres` of each is what one period covers.

#include "examples/hall/picture.h"

namespace promenade::hall {

inline constexpr double kTilesMetres = 2.4;  ///< four by four tiles of 0.6 m
inline constexpr double kMarbleMetres = 1.8;
inline constexpr double kPlasterMetres = 2.4;
inline constexpr double kFabricMetres = 0.6;
inline constexpr double kWoodMetres = 1.2;  ///< grain along v

[[nodiscard]] Picture stoneTiles();  ///< chequered limestone and grey-brown stone
[[nodiscard]] Picture stoneTilesNormals();
[[nodiscard]] Picture paleMarble();  ///< of the columns: nearly white with soft grey veins
[[nodiscard]] Picture darkMarble();  ///< of the polished band: deep green with pale veins
[[nodiscard]] Picture plaster();
[[nodiscard]] Picture plasterNormals();
[[nodiscard]] Picture damask();  ///< of the picture wall: red with a woven ornament
[[nodiscard]] Picture wood();
[[nodiscard]] Picture glazedPorcelain();  ///< blue on white; u once around the vase, v its height

}  // namespace promenade::hall
