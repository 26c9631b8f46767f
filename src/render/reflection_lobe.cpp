#include "src/render/reflection_lobe.h"

#include <hwy/highway.h>

#include <numbers>

namespace promenade::render {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr hn::CappedTag<float, LightField::kLanes> kTag;
using Vector = hn::Vec<decltype(kTag)>;

/// The cells of a field, a coordinate at a time.
struct Cells {
  LightField::Weights x, y, z, solidAngle;
};

const Cells& cells() {
  static const Cells table = [] {
    Cells cells;
    for (std::size_t i = 0; i < LightField::kCells; ++i) {
      const glm::vec3& direction = LightField::directions()[i];
      cells.x.cell[i] = direction.x;
      cells.y.cell[i] = direction.y;
      cells.z.cell[i] = direction.z;
      cells.solidAngle.cell[i] = LightField::solidAngles()[i];
    }
    return cells;
  }();
  return table;
}

/// E(cosine): TablePosition::on() and read() of all lanes.
Vector readMasking(const SpecularAlbedoTable::Masking& table, Vector cosine, Vector alpha) {
  constexpr auto kLast = static_cast<float>(SpecularAlbedoTable::kCosines - 1);
  const Vector one = hn::Set(kTag, 1.0f);
  const Vector coordinate =
      hn::Sqrt(hn::Div(hn::Mul(cosine, hn::Add(one, alpha)), hn::Add(cosine, alpha)));  // maskingCoordinate()
  const Vector scaled = hn::Mul(hn::Min(coordinate, one), hn::Set(kTag, kLast));
  const Vector below = hn::Min(hn::Floor(scaled), hn::Set(kTag, kLast - 1.0f));
  const auto index = hn::ConvertTo(hn::RebindToSigned<decltype(kTag)>(), below);
  const Vector low = hn::GatherIndex(kTag, table.data(), index);
  const Vector high = hn::GatherIndex(kTag, table.data() + 1, index);
  return hn::MulAdd(hn::Sub(high, low), hn::Sub(scaled, below), low);
}

}  // namespace

LightField::Weights weigh(const ReflectionLobe& lobe, const Basis& shading, const Basis& field) {
  static const Cells& kCells = cells();
  const auto set = [](float value) { return hn::Set(kTag, value); };
  const auto axis = [&](const glm::vec3& local, std::size_t i) {
    return hn::MulAdd(set(glm::dot(field.x, local)), hn::Load(kTag, kCells.x.at(i)),
                      hn::MulAdd(set(glm::dot(field.y, local)), hn::Load(kTag, kCells.y.at(i)),
                                 hn::Mul(set(glm::dot(field.z, local)), hn::Load(kTag, kCells.z.at(i)))));
  };
  const float alpha2 = lobe.alpha * lobe.alpha;
  const Vector one = set(1.0f);
  const Vector least = set(1e-6f);
  const Vector alphaSquared = set(alpha2);
  const Vector cosOut = set(lobe.wo.z);
  const Vector rootOut = set(std::sqrt(alpha2 + (1.0f - alpha2) * lobe.wo.z * lobe.wo.z));
  LightField::Weights weights;
  for (std::size_t i = 0; i < LightField::kCells; i += hn::Lanes(kTag)) {
    const Vector wiX = axis(shading.x, i);
    const Vector wiY = axis(shading.y, i);
    const Vector wiZ = axis(shading.z, i);
    const Vector cosIn = hn::Max(wiZ, least);
    // Between unit vectors |wo + wi|^2 = 2 (1 + wo.wi), wo.h = |wo + wi| / 2 and h.z = (wo + wi).z / |wo +
    // wi|.
    const Vector cosine =
        hn::MulAdd(wiX, set(lobe.wo.x), hn::MulAdd(wiY, set(lobe.wo.y), hn::Mul(wiZ, cosOut)));
    const Vector length2 = hn::Max(hn::Mul(set(2.0f), hn::Add(one, cosine)), least);
    const Vector sum = hn::Add(cosIn, cosOut);
    const Vector height2 = hn::Min(hn::Mul(sum, sum), length2);  // h.z^2 |wo + wi|^2
    // Ggx::distribution() without pi, and Ggx::visibility(), both times |wo + wi|^4.
    const Vector t = hn::MulAdd(height2, hn::Sub(alphaSquared, one), length2);
    const Vector rootIn =
        hn::Sqrt(hn::MulAdd(hn::Sub(one, alphaSquared), hn::Mul(cosIn, cosIn), alphaSquared));
    const Vector facets = hn::Div(
        hn::Mul(hn::Mul(set(0.5f / std::numbers::pi_v<float>), alphaSquared), hn::Mul(length2, length2)),
        hn::Mul(hn::Mul(t, t), hn::MulAdd(cosIn, rootOut, hn::Mul(cosOut, rootIn))));
    const Vector grazing = hn::Max(hn::NegMulAdd(set(0.5f), hn::Sqrt(length2), one), hn::Zero(kTag));
    const Vector grazing2 = hn::Mul(grazing, grazing);
    const Vector schlick = hn::Mul(hn::Mul(grazing2, grazing2), grazing);
    const Vector fresnel = hn::MulAdd(set(lobe.f90 - lobe.f0), schlick, set(lobe.f0));
    const Vector missing = hn::Sub(one, readMasking(lobe.masking, cosIn, set(lobe.alpha)));
    const Vector value = hn::Mul(hn::MulAdd(fresnel, facets, hn::Mul(set(lobe.again), missing)),
                                 hn::Mul(cosIn, hn::Load(kTag, kCells.solidAngle.at(i))));
    hn::Store(hn::IfThenElseZero(hn::Gt(wiZ, hn::Zero(kTag)), value), kTag, weights.at(i));
  }
  return weights;
}

}  // namespace promenade::render
