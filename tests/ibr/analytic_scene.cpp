#include "tests/ibr/analytic_scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace promenade::ibr::tests {
namespace {

constexpr double kPi = std::numbers::pi;

Intersect nearestOf(std::vector<Intersect> shapes) {
  return [shapes = std::move(shapes)](const glm::dvec3& origin, const glm::dvec3& direction) {
    std::optional<Hit> best;
    for (const Intersect& shape : shapes) {
      const auto hit = shape(origin, direction);
      if (hit && (!best || hit->distance < best->distance)) best = hit;
    }
    return best;
  };
}

}  // namespace

Intersect rectangle(const glm::dvec3& corner, const glm::dvec3& edge, const glm::dvec3& otherEdge) {
  const glm::dvec3 normal = glm::normalize(glm::cross(edge, otherEdge));
  return [=](const glm::dvec3& origin, const glm::dvec3& direction) -> std::optional<Hit> {
    const double distance = glm::dot(normal, corner - origin) / glm::dot(normal, direction);
    if (!(distance > 1e-9) || !std::isfinite(distance)) return std::nullopt;
    const glm::dvec3 inside = origin + distance * direction - corner;
    const double u = glm::dot(inside, edge) / glm::dot(edge, edge);
    const double v = glm::dot(inside, otherEdge) / glm::dot(otherEdge, otherEdge);
    if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) return std::nullopt;
    return Hit{distance, normal};
  };
}

Intersect sphere(const glm::dvec3& centre, double radius) {
  return [=](const glm::dvec3& origin, const glm::dvec3& direction) -> std::optional<Hit> {
    const glm::dvec3 out = origin - centre;
    const double a = glm::dot(direction, direction);
    const double b = glm::dot(out, direction);
    const double discriminant = b * b - a * (glm::dot(out, out) - radius * radius);
    if (discriminant < 0.0) return std::nullopt;
    const double distance = (-b - std::sqrt(discriminant)) / a;
    if (!(distance > 1e-9)) return std::nullopt;
    return Hit{distance, (out + distance * direction) / radius};
  };
}

Intersect box(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 x(high.x - low.x, 0, 0);
  const glm::dvec3 y(0, high.y - low.y, 0);
  const glm::dvec3 z(0, 0, high.z - low.z);
  return nearestOf({rectangle(low, x, y), rectangle(low, x, z), rectangle(low, y, z),
                    rectangle(low + z, x, y), rectangle(low + y, x, z), rectangle(low + x, y, z)});
}

Intersect prism(const glm::dvec3& base, double radius, double height, int sides) {
  const auto corner = [&](int i) {
    const double angle = 2.0 * kPi * i / sides;
    return base + radius * glm::dvec3(std::cos(angle), 0.0, std::sin(angle));
  };
  std::vector<Intersect> faces;
  for (int i = 0; i < sides; ++i) {
    // Tall faces: v runs along y, u across; the two are perpendicular, as rectangle() wants.
    faces.push_back(rectangle(corner(i), corner(i + 1) - corner(i), glm::dvec3(0.0, height, 0.0)));
  }
  return nearestOf(std::move(faces));
}

Texture uniform(Rgb radiance) {
  return [=](const glm::dvec3&) { return radiance; };
}

Texture waves(double wavelength) {
  return [=](const glm::dvec3& p) {
    const glm::dvec3 phase = p * (2.0 * kPi / wavelength);
    const double sum = std::sin(phase.x) + std::sin(phase.y + 1.0) + std::sin(phase.z + 2.0);
    const double other = std::cos(phase.x - 0.5) + std::cos(phase.y) + std::cos(phase.z + 0.7);
    return Rgb(glm::dvec3(0.5 + 0.4 / 3.0 * sum, 0.5 + 0.4 / 3.0 * other, 0.5 - 0.4 / 3.0 * sum));
  };
}

Texture stripes(double period) {
  return [=](const glm::dvec3& p) {
    const double phase = (p.x + p.y + p.z) / period;
    return phase - std::floor(phase) < 0.5 ? Rgb(0.05f) : Rgb(0.95f);
  };
}

AnalyticScene& AnalyticScene::add(ItemId item, Intersect shape, Texture texture) {
  things_.push_back({item, std::move(shape), std::move(texture)});
  return *this;
}

AnalyticScene& AnalyticScene::setBackground(Texture texture) {
  background_ = std::move(texture);
  return *this;
}

AnalyticScene::Nearest AnalyticScene::nearest(const glm::dvec3& origin, const glm::dvec3& direction) const {
  Nearest best;
  for (const Thing& thing : things_) {
    const auto hit = thing.shape(origin, direction);
    if (hit && (best.thing == nullptr || hit->distance < best.hit.distance)) best = {&thing, *hit};
  }
  return best;
}

Visibility AnalyticScene::visibility(const Camera& camera) const {
  return render(camera).visibility;
}

Frame AnalyticScene::render(const Camera& camera) const {
  const Size size = camera.size();
  Frame frame{{camera, DepthMap(size), NormalMap(size), ItemBuffer(size)},
              RadianceMap(size),
              RadianceMap(size),
              SourceMap(size)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 direction = camera.direction({x + 0.5, y + 0.5});
      const glm::dvec3& eye = camera.pose().eye;
      const Nearest found = nearest(eye, direction);
      Rgb& radiance = frame.diffuse(x, y);
      if (found.thing == nullptr) {
        frame.visibility.depth(x, y) = std::numeric_limits<float>::infinity();
        radiance = background_(glm::normalize(direction));
      } else {
        const glm::dvec3 normal = found.hit.normal;
        frame.visibility.depth(x, y) = static_cast<float>(found.hit.distance);
        frame.visibility.normal(x, y) = glm::vec3(glm::dot(normal, direction) > 0.0 ? -normal : normal);
        frame.visibility.item(x, y) = found.thing->item;
        radiance = found.thing->texture(eye + found.hit.distance * direction);
      }
      frame.viewDependent(x, y) = 0.25f * radiance;
    }
  }
  return frame;
}

bool AnalyticScene::sees(const glm::dvec3& eye, const glm::dvec3& point) const {
  const Nearest found = nearest(eye, point - eye);
  return found.thing == nullptr || found.hit.distance > 1.0 - 1e-5;
}

Camera cameraAt(const glm::dvec3& eye, Size size, double focalPixels) {
  return turnedCamera(eye, 0.0, 0.0, 0.0, size, focalPixels);
}

Camera turnedCamera(const glm::dvec3& eye, double yaw, double pitch, double roll, Size size,
                    double focalPixels) {
  const glm::dmat3 aboutY(glm::dvec3(std::cos(yaw), 0, -std::sin(yaw)), glm::dvec3(0, 1, 0),
                          glm::dvec3(std::sin(yaw), 0, std::cos(yaw)));
  const glm::dmat3 aboutX(glm::dvec3(1, 0, 0), glm::dvec3(0, std::cos(pitch), std::sin(pitch)),
                          glm::dvec3(0, -std::sin(pitch), std::cos(pitch)));
  const glm::dmat3 aboutZ(glm::dvec3(std::cos(roll), std::sin(roll), 0),
                          glm::dvec3(-std::sin(roll), std::cos(roll), 0), glm::dvec3(0, 0, 1));
  const double fieldOfView = 2.0 * std::atan(0.5 * size.height / focalPixels);
  return Camera({aboutY * aboutX * aboutZ, eye}, fieldOfView, size);
}

double rmse(const RadianceMap& a, const RadianceMap& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const glm::dvec3 d(a.pixels()[i] - b.pixels()[i]);
    sum += glm::dot(d, d) / 3.0;
  }
  return std::sqrt(sum / static_cast<double>(a.pixels().size()));
}

double psnr(const RadianceMap& a, const RadianceMap& b, const Mask& counts) {
  double sum = 0.0;
  double n = 0.0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    if (!counts.empty() && counts.pixels()[i] == 0) continue;
    const glm::dvec3 difference = glm::dvec3(a.pixels()[i]) - glm::dvec3(b.pixels()[i]);
    sum += glm::dot(difference, difference);
    n += 3.0;
  }
  return sum > 0.0 ? -10.0 * std::log10(sum / n) : std::numeric_limits<double>::infinity();
}

}  // namespace promenade::ibr::tests
