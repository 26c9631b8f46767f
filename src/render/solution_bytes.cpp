// A light solution as the contents of a file, and back (docs/formats.md, "Light solution").

#include <bit>
#include <cmath>
#include <cstring>

#include "src/core/fnv1a.h"
#include "src/render/irradiance_solution.h"
#include "src/render/path_renderer.h"

namespace promenade::render {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

/// Changes with the layout and with what decides the light.
constexpr std::string_view kSignature = "PromenadeLight8\n";

std::uint64_t checksum(std::string_view bytes) {
  return fnv1a(std::as_bytes(std::span(bytes)));
}

class Writer {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes_.append(raw, sizeof(T));
  }
  void add(const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void addText(std::string_view text) { bytes_.append(text); }
  [[nodiscard]] std::string take() { return std::move(bytes_); }
  [[nodiscard]] std::string_view bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads past the end give zeros, and good() says so.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  [[nodiscard]] T get() {
    T value{};
    if (!has(sizeof(T))) return value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  [[nodiscard]] glm::vec3 getVector() {
    glm::vec3 v;
    for (int i = 0; i < 3; ++i) v[i] = get<float>();
    return v;
  }
  [[nodiscard]] std::string_view getText(std::size_t count) {
    if (!has(count)) return {};
    const std::string_view text = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return text;
  }
  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  bool has(std::size_t count) {
    good_ = good_ && rest_.size() >= count;
    return good_;
  }
  std::string_view rest_;
  bool good_ = true;
};

constexpr std::size_t kRecordBytes = 14 * sizeof(float) + sizeof(std::uint32_t);  // without its walls
constexpr std::size_t kFieldBytes = LightField::kCells * sizeof(std::uint32_t);

void addRecords(Writer& out, const IrradianceRecords& records) {
  out.add(static_cast<std::uint64_t>(records.places().size()));
  out.add(static_cast<std::uint32_t>(records.fields().empty() ? 0 : 1));
  for (std::size_t i = 0; i < records.places().size(); ++i) {
    const RecordPlace& place = records.places()[i];
    const SurfaceLight& light = records.light()[i];
    out.add(place.position);
    out.add(place.normal);
    out.add(place.reach);
    out.add(light.radiance);
    out.add(light.meanDirection);
    out.add(light.error);
    const std::span<const RecordWall> walls = records.wallsOf(i);
    out.add(static_cast<std::uint32_t>(walls.size()));
    for (const RecordWall& wall : walls) {
      out.add(wall.normal);
      out.add(wall.offset);
    }
    if (records.fields().empty()) continue;
    for (const std::uint32_t cell : records.fields()[i].packed()) out.add(cell);
  }
}

[[nodiscard]] bool isFinite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

[[nodiscard]] std::optional<IrradianceRecords> recordsFrom(Reader& in, IrradianceRecords::Noise noise) {
  const auto count = in.get<std::uint64_t>();
  const bool hasFields = in.get<std::uint32_t>() != 0;
  if (count > in.left() / (kRecordBytes + (hasFields ? kFieldBytes : 0))) return std::nullopt;
  IrradianceRecords records;
  std::vector<SurfaceLight> lights;
  std::vector<LightField> fields(hasFields ? count : 0);
  for (std::uint64_t i = 0; i < count; ++i) {
    RecordPlace place;
    place.position = in.getVector();
    place.normal = in.getVector();
    place.reach = in.get<float>();
    SurfaceLight light;
    light.radiance = in.getVector();
    light.meanDirection = in.getVector();
    light.error = in.get<float>();
    const auto wallCount = in.get<std::uint32_t>();
    if (wallCount > in.left() / (4 * sizeof(float))) return std::nullopt;
    std::vector<RecordWall> walls(wallCount);
    for (RecordWall& wall : walls) {
      wall.normal = in.getVector();
      wall.offset = in.get<float>();
      if (!isFinite(wall.normal) || !std::isfinite(wall.offset) || wall.offset >= 0.0f) return std::nullopt;
    }
    if (!isFinite(place.position) || !isFinite(place.normal) || !isFinite(light.radiance) ||
        !isFinite(light.meanDirection) || !(place.reach > 0.0f) || !std::isfinite(place.reach)) {
      return std::nullopt;
    }
    records.place(place, walls);
    lights.push_back(light);
    if (!hasFields) continue;
    for (std::uint32_t& cell : fields[i].packed()) cell = in.get<std::uint32_t>();
  }
  records.setLight(std::move(lights), std::move(fields), noise);
  return records;
}

}  // namespace

bool isWholeFor(const Camera& camera, const LightSolution& solution) {
  return solution.isFor(camera);
}

LightSolutionSize sizeOf(const LightSolution& solution) {
  return {solution.coarse.places().size() + solution.fine.places().size(), solution.cameras.size(),
          solution.rays.scattered + solution.rays.shadow};
}

std::string toBytes(const LightSolution& solution, std::string_view key) {
  Writer out;
  out.addText(kSignature);
  out.add(static_cast<std::uint64_t>(key.size()));
  out.addText(key);
  out.add(static_cast<std::uint64_t>(solution.cameras.size()));
  for (const std::uint64_t camera : solution.cameras) out.add(camera);
  addRecords(out, solution.coarse);
  addRecords(out, solution.fine);
  out.add(checksum(out.bytes()));
  return out.take();
}

std::shared_ptr<const LightSolution> lightSolutionFrom(std::string_view bytes, std::string_view key) {
  constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);
  if (bytes.size() < kSignature.size() + kChecksumBytes || !bytes.starts_with(kSignature)) return nullptr;
  const std::string_view contents = bytes.substr(0, bytes.size() - kChecksumBytes);
  if (Reader(bytes.substr(contents.size())).get<std::uint64_t>() != checksum(contents)) return nullptr;
  Reader in(contents.substr(kSignature.size()));
  if (in.getText(in.get<std::uint64_t>()) != key) return nullptr;
  LightSolution solution;
  const auto cameras = in.get<std::uint64_t>();
  if (cameras > in.left() / sizeof(std::uint64_t)) return nullptr;
  for (std::uint64_t i = 0; i < cameras; ++i) solution.cameras.push_back(in.get<std::uint64_t>());
  std::optional<IrradianceRecords> coarse = recordsFrom(in, IrradianceRecords::Noise::kLeftIn);
  std::optional<IrradianceRecords> fine = recordsFrom(in, IrradianceRecords::Noise::kTakenOut);
  if (!coarse || !fine || !in.good() || in.left() != 0) return nullptr;
  solution.coarse = std::move(*coarse);
  solution.fine = std::move(*fine);
  return std::make_shared<const LightSolution>(std::move(solution));
}

}  // namespace promenade::render
