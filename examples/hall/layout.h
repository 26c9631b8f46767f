#pragma once
// Where things stand. The nave runs along Z between two rows of columns, an aisle on either side; the left
// (-X) wall has the windows, the right (+X) wall the pictures, an apse closes the far (-Z) end. Floor at y =
// 0. Metres.

#include <array>
#include <numbers>

namespace promenade::hall {

inline constexpr double kTurn = 2.0 * std::numbers::pi;  ///< radians

inline constexpr double kBay = 3.6;          ///< column to column
inline constexpr double kHalfLength = 10.8;  ///< three bays each way
inline constexpr double kColumnX = 4.0;
inline constexpr double kColumnTop = 4.7;
inline constexpr double kWallX = 7.4;
inline constexpr double kBeamHalf = 0.4;  ///< half the width of the beam on the columns
inline constexpr double kAisleCeiling = 5.2;
inline constexpr double kSpringing = 5.7;  ///< where the vault begins
inline constexpr double kVaultRadius = kColumnX - kBeamHalf;
inline constexpr double kBandHalf = 1.2;  ///< half the width of the polished band in the floor
inline constexpr double kApseRadius = 2.0;
inline constexpr double kApseSpringing = 3.3;
inline constexpr double kApseReveal = 0.5;

inline constexpr std::array<double, 6> kColumnZ{-9.0, -5.4, -1.8, 1.8, 5.4, 9.0};
inline constexpr std::array<double, 5> kBayZ{-7.2, -3.6, 0.0, 3.6, 7.2};

}  // namespace promenade::hall
