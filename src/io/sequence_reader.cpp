#include <utility>

#include "src/core/errors.h"
#include "src/io/sequence.h"
#include "src/io/video.h"

namespace promenade::io {

struct SequenceReader::State {
  explicit State(Sequence&& given) : sequence(std::move(given)) {
    if (!sequence.isVideo()) return;
    if (!sequence.layer.empty()) {
      throw InputError(sequence.video.string(), "--layer: only OpenEXR files have layers, this is a video");
    }
    video.emplace(sequence.video);
  }
  Sequence sequence;
  std::optional<VideoReader> video;
  int nextFrame = 0;
  Size firstSize;
};

SequenceReader::SequenceReader(Sequence sequence) : state_(std::make_unique<State>(std::move(sequence))) {}
SequenceReader::SequenceReader(SequenceReader&&) noexcept = default;
SequenceReader& SequenceReader::operator=(SequenceReader&&) noexcept = default;
SequenceReader::~SequenceReader() = default;

int SequenceReader::frameCount() const {
  return state_->video ? state_->video->frameCount() : static_cast<int>(state_->sequence.images.size());
}

std::optional<double> SequenceReader::framesPerSecond() const {
  if (!state_->video) return std::nullopt;
  return state_->video->frameRate().framesPerSecond();
}

const std::filesystem::path& SequenceReader::file(int frame) const {
  return state_->video ? state_->sequence.video : state_->sequence.images[static_cast<std::size_t>(frame)];
}

std::optional<ImageFile> SequenceReader::next() {
  State& state = *state_;
  if (state.nextFrame >= frameCount()) return std::nullopt;
  const int frame = state.nextFrame++;
  ImageFile image;
  if (state.video) {
    auto decoded = state.video->next();
    if (!decoded) return std::nullopt;
    image.colour = std::move(*decoded);
  } else {
    image = readImage(file(frame), state.sequence.layer);
  }
  if (frame == 0) state.firstSize = image.size();
  if (image.size() != state.firstSize) {
    throw InputError(file(frame).string(), "expected the size of the first frame, " +
                                               toString(state.firstSize) + ", found " +
                                               toString(image.size()));
  }
  return image;
}

}  // namespace promenade::io
