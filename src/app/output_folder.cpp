#include "src/app/output_folder.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "src/app/folders.h"
#include "src/core/errors.h"
#include "src/io/atomic_file.h"
#include "src/io/exr_frame.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;

// Files whose names are digits and `extension`.
std::vector<fs::path> numbered(const fs::path& folder, const char* extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool digits = !stem.empty() && stem.find_first_not_of("0123456789") == std::string::npos;
    if (digits && entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void removeFile(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw InputError(file.string(), "cannot be removed: " + error.message());
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, const std::string& hash, Existing existing)
    : folder_(std::move(folder)) {
  for (const char* part : {"frames", "parts"}) makeFolder(folder_ / part);
  if (existing != Existing::kShare) {
    for (const char* part : {"", "frames", "parts", "tasks", "keyframes", "maps"}) {
      if (fs::is_directory(folder_ / part)) io::removeLeftoverTemporaries(folder_ / part);
    }
  }
  // Creating and discarding a file shows whether the folder can be written, before any work is done.
  const io::AtomicFile probe(folder_ / "frames" / "probe");
  if (existing == Existing::kShare) return;
  if (existing == Existing::kOverwrite) {
    removeJob();
    return;
  }
  for (const fs::path& frame : numbered(folder_ / "frames", ".exr")) {
    if (io::readFrameMetadata(frame).jobHash != hash) {
      throw InputError(folder_.string(), "holds frames of another job (" + frame.filename().string() +
                                             "); choose another folder, or --overwrite to replace them");
    }
  }
}

void OutputFolder::removeJob() const {
  // The report first and the records before the frames: whenever this ends, nothing claims to be done.
  for (const char* name : {"report.json", "report.html", "walkthrough.mp4", "plan.json", "prepared.json",
                           "light.json", "division.json"}) {
    removeFile(folder_ / name);
  }
  for (const char* records : {"parts", "tasks"}) {
    if (!fs::is_directory(folder_ / records)) continue;
    for (const fs::path& record : numbered(folder_ / records, ".json")) removeFile(record);
  }
  for (const fs::path& frame : numbered(folder_ / "frames", ".exr")) removeFile(frame);
  removeKeyframes();
}

fs::path OutputFolder::frame(int index) const {
  return folder_ / "frames" / io::frameFileName(index);
}

fs::path OutputFolder::keyframe(int index) const {
  return folder_ / "keyframes" / io::frameFileName(index);
}

void OutputFolder::removeKeyframes() const {
  std::error_code error;
  fs::remove_all(folder_ / "keyframes", error);
  if (error) throw InputError((folder_ / "keyframes").string(), "cannot be removed: " + error.message());
}

fs::path OutputFolder::map(const std::string& name) const {
  return folder_ / "maps" / name;
}

void OutputFolder::makeMapsFolder() const {
  makeFolder(folder_ / "maps");
}

}  // namespace promenade::app
