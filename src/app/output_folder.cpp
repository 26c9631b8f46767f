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

// Files whose names are those of frames: digits and ".exr".
std::vector<fs::path> framesIn(const fs::path& folder) {
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool digits = !stem.empty() && stem.find_first_not_of("0123456789") == std::string::npos;
    if (digits && entry.path().extension() == ".exr") frames.push_back(entry.path());
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

void removeFile(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw InputError(file.string(), "cannot be removed: " + error.message());
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, const std::string& hash, Existing existing)
    : folder_(std::move(folder)) {
  makeFolder(folder_ / "frames");
  io::removeLeftoverTemporaries(folder_);
  io::removeLeftoverTemporaries(folder_ / "frames");
  for (const fs::path& frame : framesIn(folder_ / "frames")) {
    if (existing == Existing::kOverwrite) {
      removeFile(frame);
      continue;
    }
    if (io::readFrameMetadata(frame).jobHash != hash) {
      throw InputError(folder_.string(), "holds frames of another job (" + frame.filename().string() +
                                             "); choose another folder, or --overwrite to replace them");
    }
  }
  if (existing == Existing::kOverwrite) {
    for (const char* name : {"report.json", "report.html", "walkthrough.mp4"}) removeFile(folder_ / name);
  }
  // Creating and discarding a file shows whether the folder can be written, before any work is done.
  const io::AtomicFile probe(folder_ / "frames" / "probe");
}

fs::path OutputFolder::frame(int index) const {
  return folder_ / "frames" / io::frameFileName(index);
}

fs::path OutputFolder::map(const std::string& name) const {
  return folder_ / "maps" / name;
}

void OutputFolder::makeMapsFolder() const {
  makeFolder(folder_ / "maps");
}

int OutputFolder::finishedFrom(int first, int last) const {
  int index = first;
  while (index <= last && fs::is_regular_file(frame(index))) ++index;
  return index - first;
}

}  // namespace promenade::app
