#include <algorithm>
#include <string>
#include <utility>

#include "src/core/errors.h"
#include "src/io/atomic_file.h"
#include "src/io/file_error.h"
#include "src/io/libav_internal.h"
#include "src/io/video.h"
#include "src/io/video_pixels_internal.h"

extern "C" {
#include <libavutil/opt.h>
}

namespace promenade::io {
namespace {

namespace fs = std::filesystem;

struct EncoderChoice {
  const char* muxer;
  const char* encoder;
  AVPixelFormat pixelFormat;
  int threads;  // fixed: the bytes that x264 and libvpx write depend on it
};

EncoderChoice choiceFor(VideoFormat format) {
  switch (format) {
    case VideoFormat::kH264:
      return {"mp4", "libx264", AV_PIX_FMT_YUV420P, 4};
    case VideoFormat::kFfv1:
      return {"matroska", "ffv1", AV_PIX_FMT_BGR0, 4};
    case VideoFormat::kVp9:
      return {"webm", "libvpx-vp9", AV_PIX_FMT_YUV420P, 4};
    case VideoFormat::kGif:
      return {"gif", "gif", AV_PIX_FMT_PAL8, 1};
  }
  throw InputError("unknown video format");
}

bool cpuHasAvx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f");
#else
  return false;
#endif
}

// A muxer and the file it writes to.
struct MuxerDelete {
  void operator()(AVFormatContext* muxer) const {
    avio_closep(&muxer->pb);
    avformat_free_context(muxer);
  }
};
using Muxer = std::unique_ptr<AVFormatContext, MuxerDelete>;

}  // namespace

struct VideoWriter::State {
  State(const fs::path& path, Size frameSize, FrameRate frameRate);
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();
  void write(const EncodedMap& image);
  void finish();

 private:
  void configure(const EncoderChoice& choice, FrameRate frameRate);
  void option(const char* name, const char* value);
  void encode(const AVFrame* frame);
  void check(int result, const char* action) const;

  VideoFormat format_;
  Size size_;
  AtomicFile file_;  // outlives the muxer, which writes into it
  Muxer muxer_;
  CodecContext codec_;
  VideoFrame frame_;
  Packet packet_;
  AVStream* stream_ = nullptr;
  std::int64_t frames_ = 0;
  bool open_ = false;  // between the container's header and its trailer
};

void VideoWriter::State::check(int result, const char* action) const {
  // The muxer keeps going after a failed write and tells only here.
  const int error = result < 0 ? result : (muxer_ && muxer_->pb != nullptr ? muxer_->pb->error : 0);
  if (error >= 0) return;
  const int systemError = AVUNERROR(error);
  if (systemError > 0 && systemError < 1000) throwFileError(systemError, file_.finalPath(), action);
  throw CannotContinue(file_.finalPath().string() + ": cannot " + action + ": " + libavMessage(error));
}

void VideoWriter::State::option(const char* name, const char* value) {
  check(av_opt_set(codec_.get(), name, value, AV_OPT_SEARCH_CHILDREN), "set up the encoder");
}

VideoWriter::State::State(const fs::path& path, Size frameSize, FrameRate frameRate)
    : format_(videoFormatOf(path)), size_(frameSize), file_(path) {
  redirectLibavLog();
  if (size_.width < 1 || size_.height < 1) {
    throw InputError(path.string(), "expected frames of at least 1x1 pixels, found " + toString(size_));
  }
  const EncoderChoice choice = choiceFor(format_);
  const AVCodec* encoder = avcodec_find_encoder_by_name(choice.encoder);
  if (encoder == nullptr) {
    throw InputError(path.string(),
                     std::string("the FFmpeg libraries here have no encoder ") + choice.encoder);
  }
  // "file:" keeps a name with a colon from being taken for a protocol.
  const std::string url = "file:" + file_.temporaryPath().string();
  AVFormatContext* muxer = nullptr;
  check(avformat_alloc_output_context2(&muxer, nullptr, choice.muxer, url.c_str()), "set up the container");
  muxer_.reset(muxer);
  muxer_->flags |= AVFMT_FLAG_BITEXACT;  // no version strings, no random identifiers
  codec_ = allocated<CodecContext>(avcodec_alloc_context3(encoder));
  configure(choice, frameRate);
  if (const int error = avcodec_open2(codec_.get(), encoder, nullptr); error < 0) {
    throw InputError(path.string(), std::string("encoder ") + choice.encoder + " refuses frames of " +
                                        toString(size_) + ": " + libavMessage(error));
  }

  stream_ = avformat_new_stream(muxer_.get(), nullptr);
  if (stream_ == nullptr) throw std::bad_alloc();
  check(avcodec_parameters_from_context(stream_->codecpar, codec_.get()), "set up the stream");
  stream_->time_base = codec_->time_base;
  stream_->avg_frame_rate = codec_->framerate;
  stream_->r_frame_rate = codec_->framerate;

  check(avio_open(&muxer_->pb, url.c_str(), AVIO_FLAG_WRITE), "create the file");
  AVDictionary* options = nullptr;
  if (format_ == VideoFormat::kH264) av_dict_set(&options, "movflags", "+faststart", 0);
  const int headerResult = avformat_write_header(muxer_.get(), &options);
  av_dict_free(&options);
  check(headerResult, "write the header");
  open_ = true;

  frame_ = allocated<VideoFrame>(av_frame_alloc());
  frame_->format = codec_->pix_fmt;
  frame_->width = codec_->width;
  frame_->height = codec_->height;
  frame_->color_primaries = codec_->color_primaries;
  frame_->color_trc = codec_->color_trc;
  frame_->colorspace = codec_->colorspace;
  frame_->color_range = codec_->color_range;
  frame_->chroma_location = codec_->chroma_sample_location;
  check(av_frame_get_buffer(frame_.get(), 0), "allocate a frame");
  packet_ = allocated<Packet>(av_packet_alloc());
}

VideoWriter::State::~State() {
  // Some muxers give back their memory only here. The file is about to be removed: how it goes does not
  // matter.
  if (open_) (void)av_write_trailer(muxer_.get());
}

void VideoWriter::State::configure(const EncoderChoice& choice, FrameRate frameRate) {
  const bool subsampled = choice.pixelFormat == AV_PIX_FMT_YUV420P;
  const Size coded = codedSize(format_, size_);
  codec_->width = coded.width;
  codec_->height = coded.height;
  codec_->pix_fmt = choice.pixelFormat;
  codec_->framerate = {frameRate.numerator, frameRate.denominator};
  codec_->time_base = {frameRate.denominator, frameRate.numerator};
  codec_->sample_aspect_ratio = {1, 1};
  codec_->thread_count = choice.threads;
  // Two seconds between points where a player can start.
  codec_->gop_size = std::max(1, static_cast<int>(2.0 * frameRate.framesPerSecond()));
  codec_->flags |= AV_CODEC_FLAG_BITEXACT;
  if ((muxer_->oformat->flags & AVFMT_GLOBALHEADER) != 0) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  if (format_ != VideoFormat::kGif) {
    codec_->color_primaries = AVCOL_PRI_BT709;
    codec_->color_trc = subsampled ? AVCOL_TRC_BT709 : AVCOL_TRC_IEC61966_2_1;
    codec_->colorspace = subsampled ? AVCOL_SPC_BT709 : AVCOL_SPC_RGB;
    codec_->color_range = subsampled ? AVCOL_RANGE_MPEG : AVCOL_RANGE_JPEG;
    if (subsampled) codec_->chroma_sample_location = AVCHROMA_LOC_LEFT;
  }
  switch (format_) {
    case VideoFormat::kH264:
      option("preset", "medium");
      option("crf", "16");
      // What x264's AVX-512 code writes depends on where its memory lies (release 164, with mbtree).
      if (cpuHasAvx512()) option("x264-params", "asm=avx2");
      break;
    case VideoFormat::kFfv1:
      codec_->level = 3;
      codec_->gop_size = 1;  // every frame stands alone: damage stays where it is
      option("slicecrc", "1");
      // Slices are what its threads share. Small pictures cannot be divided (and version 3 would do so by
      // itself).
      codec_->slices = size_.width <= 352 && size_.height <= 288 ? 1 : 4;
      break;
    case VideoFormat::kVp9:
      codec_->bit_rate = 0;
      option("crf", "20");
      option("deadline", "good");
      option("cpu-used", "4");
      break;
    case VideoFormat::kGif:
      codec_->time_base = {frameRate.denominator, frameRate.numerator};
      break;
  }
}

void VideoWriter::State::encode(const AVFrame* frame) {
  check(avcodec_send_frame(codec_.get(), frame), "encode a frame");
  for (;;) {
    const int result = avcodec_receive_packet(codec_.get(), packet_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    check(result, "encode a frame");
    packet_->stream_index = stream_->index;
    if (packet_->duration == 0) packet_->duration = 1;
    av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
    check(av_interleaved_write_frame(muxer_.get(), packet_.get()), "write");
  }
}

void VideoWriter::State::write(const EncodedMap& image) {
  if (image.size() != size_) {
    throw InputError(file_.finalPath().string(), "frame " + std::to_string(frames_) + ": expected " +
                                                     toString(size_) + " pixels, found " +
                                                     toString(image.size()));
  }
  check(av_frame_make_writable(frame_.get()), "allocate a frame");
  fillFrame(*frame_, image);
  frame_->pts = frames_++;
  encode(frame_.get());
}

void VideoWriter::State::finish() {
  if (frames_ == 0)
    throw InputError(file_.finalPath().string(), "expected at least one frame to encode, found none");
  encode(nullptr);
  open_ = false;
  check(av_write_trailer(muxer_.get()), "write");
  avio_flush(muxer_->pb);
  check(0, "write");
  check(avio_closep(&muxer_->pb), "write");
  file_.commit();
}

VideoWriter::VideoWriter(const fs::path& file, Size size, FrameRate frameRate)
    : state_(std::make_unique<State>(file, size, frameRate)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

void VideoWriter::write(const EncodedMap& frame) {
  state_->write(frame);
}

void VideoWriter::finish() {
  state_->finish();
  state_.reset();
}

}  // namespace promenade::io
