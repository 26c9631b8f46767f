#include "src/io/image_channels.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "src/core/errors.h"

namespace promenade::io {
namespace {

std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// "ViewLayer.Combined" of "ViewLayer.Combined.R"; empty without a dot.
std::string_view beforeDot(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
}

// "R" of "ViewLayer.Combined.R".
std::string_view afterDot(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

// Channels of one part that have one prefix.
struct Layer {
  std::string name;      // the prefix, else the part's name
  bool isPlain = false;  // its channels have no prefix
  int part = 0;
  std::vector<std::pair<std::string, int>> members;  // lower-case name after the prefix, index

  [[nodiscard]] std::optional<ChannelPlace> find(std::initializer_list<std::string_view> names) const {
    for (const auto& [member, index] : members) {
      if (std::ranges::find(names, std::string_view(member)) != names.end()) return ChannelPlace{part, index};
    }
    return std::nullopt;
  }
  [[nodiscard]] std::optional<std::array<ChannelPlace, 3>> colour() const {
    const auto r = find({"r", "red"});
    const auto g = find({"g", "green"});
    const auto b = find({"b", "blue"});
    if (!r || !g || !b) return std::nullopt;
    return std::array<ChannelPlace, 3>{*r, *g, *b};
  }
  [[nodiscard]] std::optional<FlowChannels> flow() const {
    const std::string kind = lowered(afterDot(name));
    if (kind == "vector") {
      const auto x = find({"x"});
      const auto y = find({"y"});
      const auto z = find({"z"});
      const auto w = find({"w"});
      // Blender's pass: X Y lead from here to the previous frame, Z W from the next frame to here; y is up.
      if (x && y && z && w) return FlowChannels{*z, *w, {-1.0f, 1.0f}};
      if (x && y) return FlowChannels{*x, *y, glm::vec2(1.0f)};
    }
    if (kind == "forward") {
      const auto u = find({"u"});
      const auto v = find({"v"});
      if (u && v) return FlowChannels{*u, *v, {1.0f, -1.0f}};  // y is up
    }
    return std::nullopt;
  }
};

std::vector<Layer> layersOf(const std::vector<PartChannels>& parts) {
  std::vector<Layer> layers;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::size_t first = layers.size();
    for (std::size_t i = 0; i < parts[part].channels.size(); ++i) {
      const std::string_view channel = parts[part].channels[i];
      const std::string_view prefix = beforeDot(channel);
      const std::string name(prefix.empty() ? std::string_view(parts[part].name) : prefix);
      auto layer =
          std::find_if(layers.begin() + static_cast<std::ptrdiff_t>(first), layers.end(),
                       [&](const Layer& l) { return l.name == name && l.isPlain == prefix.empty(); });
      if (layer == layers.end())
        layer = layers.insert(layers.end(), {name, prefix.empty(), static_cast<int>(part), {}});
      layer->members.emplace_back(lowered(afterDot(channel)), static_cast<int>(i));
    }
  }
  return layers;
}

// What a layer shows: its three colours, or one channel three times.
std::optional<std::array<ChannelPlace, 3>> pictureOf(const Layer& layer,
                                                     const std::vector<PartChannels>& parts) {
  if (const auto colour = layer.colour()) return colour;
  const auto grey = [](ChannelPlace place) { return std::array<ChannelPlace, 3>{place, place, place}; };
  if (const auto y = layer.find({"y"}); y && !layer.find({"x"})) return grey(*y);
  std::vector<int> others;
  for (const auto& [member, index] : layer.members) {
    if (index != parts[static_cast<std::size_t>(layer.part)].alpha && member != "a" && member != "alpha")
      others.push_back(index);
  }
  if (others.size() == 1) return grey({layer.part, others.front()});
  return std::nullopt;
}

std::string listed(const std::vector<const Layer*>& layers) {
  std::string names;
  for (const Layer* layer : layers)
    names += (names.empty() ? "" : ", ") + (layer->name.empty() ? "(no name)" : layer->name);
  return names;
}

std::vector<const Layer*> coloured(const std::vector<Layer>& layers) {
  std::vector<const Layer*> result;
  for (const Layer& layer : layers) {
    if (layer.colour()) result.push_back(&layer);
  }
  return result;
}

const Layer& namedLayer(const std::vector<Layer>& layers, const std::vector<PartChannels>& parts,
                        const std::string& wanted, const std::filesystem::path& file) {
  std::vector<const Layer*> whole;
  std::vector<const Layer*> last;
  std::vector<const Layer*> shown;
  for (const Layer& layer : layers) {
    if (!pictureOf(layer, parts)) continue;
    shown.push_back(&layer);
    if (lowered(layer.name) == lowered(wanted)) whole.push_back(&layer);
    if (lowered(afterDot(layer.name)) == lowered(wanted)) last.push_back(&layer);
  }
  if (!whole.empty()) return *whole.front();
  if (last.size() == 1) return *last.front();
  if (!last.empty()) {
    throw InputError(file.string(), "--layer: several layers end in '" + wanted + "': " + listed(last));
  }
  throw InputError(file.string(),
                   "--layer: expected one of the layers " + listed(shown) + ", found '" + wanted + "'");
}

// Names of layers that hold the whole picture, not a share of its light.
constexpr std::array<std::string_view, 7> kWhole = {"combined",  "beauty", "rgba",  "rgb",
                                                    "composite", "color",  "colour"};

const Layer& chosenLayer(const std::vector<Layer>& layers, const std::vector<PartChannels>& parts,
                         const std::filesystem::path& file) {
  const std::vector<const Layer*> candidates = coloured(layers);
  // Without a prefix: of several parts the one that says that it is the picture, else the first.
  const Layer* plain = nullptr;
  for (const Layer* layer : candidates) {
    if (!layer->isPlain) continue;
    if (std::ranges::find(kWhole, lowered(layer->name)) != kWhole.end()) return *layer;
    if (plain == nullptr) plain = layer;
  }
  if (plain != nullptr) return *plain;
  // One grey channel, among whatever else has prefixes.
  for (const Layer& layer : layers) {
    if (layer.isPlain && layer.part == 0 && layer.find({"y"}) && pictureOf(layer, parts)) return layer;
  }
  for (const std::string_view whole : kWhole) {
    std::vector<const Layer*> matching;
    for (const Layer* layer : candidates) {
      if (lowered(afterDot(layer->name)) == whole) matching.push_back(layer);
    }
    if (matching.size() == 1) return *matching.front();
    if (matching.empty()) continue;
    // Of several view layers the composition of them is the picture.
    for (const Layer* layer : matching) {
      if (lowered(beforeDot(layer->name)) == "composite") return *layer;
    }
    throw InputError(file.string(),
                     "several layers are whole pictures (" + listed(matching) + "): choose one with --layer");
  }
  if (candidates.size() == 1) return *candidates.front();
  if (candidates.size() > 1) {
    throw InputError(file.string(),
                     "several layers have colour (" + listed(candidates) + "): choose one with --layer");
  }
  if (layers.size() == 1 && pictureOf(layers.front(), parts)) return layers.front();
  std::string names;
  for (const std::string& name : parts.front().channels) names += (names.empty() ? "" : ", ") + name;
  throw InputError(file.string(), "expected channels R, G and B, or Y, found " + names);
}

// Beside the picture's layer, else the only one of the file.
std::optional<FlowChannels> chosenFlow(const std::vector<Layer>& layers, const Layer& picture) {
  std::vector<FlowChannels> all;
  for (const Layer& layer : layers) {
    const auto flow = layer.flow();
    if (!flow) continue;
    if (!beforeDot(layer.name).empty() && beforeDot(layer.name) == beforeDot(picture.name)) return flow;
    if (beforeDot(layer.name).empty() && picture.isPlain && layer.part == picture.part) return flow;
    all.push_back(*flow);
  }
  return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
}

}  // namespace

ChosenChannels chooseChannels(const std::vector<PartChannels>& parts, const std::string& layer,
                              const std::filesystem::path& file) {
  const std::vector<Layer> layers = layersOf(parts);
  const Layer& picture =
      layer.empty() ? chosenLayer(layers, parts, file) : namedLayer(layers, parts, layer, file);
  ChosenChannels chosen{*pictureOf(picture, parts), chosenFlow(layers, picture), std::nullopt};
  chosen.luminance = picture.find({"y"});
  for (const Layer& other : layers) {
    if (!chosen.luminance && layer.empty() && other.isPlain) chosen.luminance = other.find({"y"});
  }
  return chosen;
}

}  // namespace promenade::io
