#pragma once
// The folder a job fills: frames/000000.exr and on, walkthrough.mp4, report.json, report.html, maps/, and
// what is needed to go on with it: prepared.json, light.json, division.json, parts/. A plan for many machines
// (farm_plan.h) adds plan.json, tasks/, keyframes/.

#include <filesystem>
#include <string>

namespace promenade::app {

enum class Existing {
  kResume,     ///< go on with frames of this very job; refuse those of another (the default)
  kOverwrite,  ///< remove what is there and begin again
  kShare,      ///< other processes write there at the same time: look at nothing, remove nothing
};

class OutputFolder {
 public:
  /// Makes the folder and finds out what it holds, before any long work. Leftovers of killed runs are
  /// removed. Throws InputError if it cannot be written or (kResume) holds frames that are not of the job
  /// `hash`.
  OutputFolder(std::filesystem::path folder, const std::string& hash, Existing existing);

  [[nodiscard]] std::filesystem::path frame(int index) const;
  /// Of a keyframe that is handed on at sample resolution.
  [[nodiscard]] std::filesystem::path keyframe(int index) const;
  [[nodiscard]] std::filesystem::path map(const std::string& name) const;
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  void makeMapsFolder() const;
  /// What many machines needed of each other (keyframes/).
  void removeKeyframes() const;

 private:
  void removeJob() const;

  std::filesystem::path folder_;
};

}  // namespace promenade::app
