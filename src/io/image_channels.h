#pragma once
// Private to src/io: which channels of an image file are its colour, its flow and its luminance. OpenEXR
// files of compositors hold many layers, as prefixes of the channels' names (ViewLayer.Combined.R) or as
// parts of the file.

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace promenade::io {

/// One part of a file and its channels, in the order of the file.
struct PartChannels {
  std::string name;  ///< empty where the file has one part only
  std::vector<std::string> channels;
  int alpha = -1;  ///< index of the alpha channel; -1: none
};

struct ChannelPlace {
  int part = 0;
  int channel = 0;
};

struct FlowChannels {
  ChannelPlace x, y;
  /// What the values are to be multiplied by to be pixels to the next frame, y down.
  glm::vec2 scale{1.0f};
};

struct ChosenChannels {
  std::array<ChannelPlace, 3> colour;
  std::optional<FlowChannels> flow;
  std::optional<ChannelPlace> luminance;
};

/// `layer`: the layer of the colour, by its whole name or by its last component where only one layer has
/// that; empty: channels without a prefix (of several parts of the one called beauty, rgba or the like, else
/// of the first that has them), else the layer that holds the whole picture (Combined, beauty, rgba, ...),
/// else the only one with colour. Flow: Vector.X and .Y (with .Z and .W: Blender's) or forward.u and .v
/// (Nuke's), beside that layer or else the only one. Throws InputError that names `file` and lists its layers
/// if no colour, or more than one, comes into question.
[[nodiscard]] ChosenChannels chooseChannels(const std::vector<PartChannels>& parts, const std::string& layer,
                                            const std::filesystem::path& file);

}  // namespace promenade::io
