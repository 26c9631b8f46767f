#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "src/core/errors.h"
#include "src/io/file_error.h"
#include "src/io/image_limits.h"
#include "src/io/libav_internal.h"
#include "src/io/video.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;

struct DemuxerDelete {
  void operator()(AVFormatContext* demuxer) const { avformat_close_input(&demuxer); }
};
using Demuxer = std::unique_ptr<AVFormatContext, DemuxerDelete>;

[[noreturn]] void fail(const fs::path& file, const std::string& what, int error) {
  if (error == AVERROR(ENOMEM)) throw std::bad_alloc();
  throw InputError(file.string(), what + ": " + libavMessage(error));
}

Demuxer openDemuxer(const fs::path& file) {
  AVDictionary* options = nullptr;
  // Plain containers and plain files only: playlists and the like would open other files.
  av_dict_set(&options, "format_whitelist", "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,gif", 0);
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  AVFormatContext* opened = nullptr;
  const int result = avformat_open_input(&opened, ("file:" + file.string()).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (result < 0) fail(file, "cannot read as a video", result);
  Demuxer demuxer(opened);
  if (const int error = avformat_find_stream_info(demuxer.get(), nullptr); error < 0) {
    fail(file, "cannot read as a video", error);
  }
  return demuxer;
}

// A GIF ends with 0x3B. Its demuxer does not mind when the end is missing.
bool lacksGifTrailer(const AVFormatContext& demuxer, const fs::path& file) {
  if (std::string_view(demuxer.iformat->name) != "gif") return false;
  std::ifstream in(file, std::ios::binary);
  in.seekg(-1, std::ios::end);
  return in.get() != 0x3B;
}

// Counts the frames by their packets, and finds out whether the end of the file is missing.
int countFrames(const fs::path& file, int stream) {
  const Demuxer demuxer = openDemuxer(file);
  const Packet packet = allocated<Packet>(av_packet_alloc());
  const AVStream& video = *demuxer->streams[stream];
  std::int64_t packets = 0;
  int shown = 0;
  double end = 0.0;  // seconds
  const auto cutShort = [&](const std::string& detail) {
    throw InputError(file.string(), "the video is cut short or damaged after " + std::to_string(shown) +
                                        " frames" + (detail.empty() ? "" : ": " + detail));
  };
  for (;;) {
    const int result = av_read_frame(demuxer.get(), packet.get());
    if (result == AVERROR_EOF) break;
    if (result < 0) cutShort(libavMessage(result));
    if (packet->stream_index == stream) {
      if ((packet->flags & AV_PKT_FLAG_CORRUPT) != 0) cutShort("a frame is incomplete");
      ++packets;
      if ((packet->flags & AV_PKT_FLAG_DISCARD) == 0) ++shown;
      if (packet->pts != AV_NOPTS_VALUE) {
        end = std::max(end, static_cast<double>(packet->pts + packet->duration) * av_q2d(video.time_base));
      }
    }
    av_packet_unref(packet.get());
  }
  if (demuxer->pb != nullptr && demuxer->pb->error < 0) cutShort(libavMessage(demuxer->pb->error));
  if (video.nb_frames > 0 && packets < video.nb_frames) {
    cutShort("expected " + std::to_string(video.nb_frames));
  }
  // Matroska states no count, but how long it lasts.
  const bool matroska = std::string_view(demuxer->iformat->name).find("matroska") != std::string_view::npos;
  if (matroska && demuxer->duration != AV_NOPTS_VALUE && video.avg_frame_rate.num > 0) {
    const double stated = static_cast<double>(demuxer->duration) / AV_TIME_BASE;
    if (demuxer->nb_streams == 1 && stated - end > 0.5 * av_q2d(av_inv_q(video.avg_frame_rate)) + 0.002) {
      cutShort("expected " + std::to_string(stated) + " s, found " + std::to_string(end) + " s");
    }
  }
  if (lacksGifTrailer(*demuxer, file)) cutShort("its end is missing");
  if (shown == 0) throw InputError(file.string(), "expected a video, found no frame in it");
  return shown;
}

// Matrix of a frame as swscale names it (the values of AVColorSpace, H.273).
int matrixOf(const AVFrame& frame) {
  if (frame.colorspace != AVCOL_SPC_UNSPECIFIED && frame.colorspace != AVCOL_SPC_RGB) return frame.colorspace;
  return frame.height < 720 ? SWS_CS_ITU601 : SWS_CS_ITU709;
}

}  // namespace

struct VideoReader::State {
  explicit State(const fs::path& path);
  std::optional<EncodedMap> next();

  fs::path file;
  Demuxer demuxer;
  ErrorCount concealed = 0;  // outlives the decoder
  CodecContext codec;
  Packet packet;
  VideoFrame frame;
  Scaler scaler;
  int stream = 0;
  int frameCount = 0;
  int decoded = 0;
  FrameRate frameRate;
  Size size;

 private:
  void feed();
  EncodedMap toRgb();
};

VideoReader::State::State(const fs::path& path) : file(path) {
  redirectLibavLog();
  requireRegularFile(file);
  demuxer = openDemuxer(file);
  const AVCodec* decoder = nullptr;
  stream = av_find_best_stream(demuxer.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
  if (stream < 0 || decoder == nullptr)
    throw InputError(file.string(), "expected a video, found no video stream");
  AVStream* video = demuxer->streams[stream];
  size = {video->codecpar->width, video->codecpar->height};
  requireReasonableSize(file, size);
  const AVRational rate = av_guess_frame_rate(demuxer.get(), video, nullptr);
  if (rate.num > 0 && rate.den > 0) frameRate = {rate.num, rate.den};
  frameCount = countFrames(file, stream);

  codec = allocated<CodecContext>(avcodec_alloc_context3(decoder));
  if (const int error = avcodec_parameters_to_context(codec.get(), video->codecpar); error < 0) {
    fail(file, "cannot decode", error);
  }
  codec->pkt_timebase = video->time_base;
  codec->max_pixels = static_cast<std::int64_t>(kMaximumPixels);
  // A damaged frame is an error here, not something to conceal.
  codec->err_recognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER | AV_EF_EXPLODE;
  codec->opaque = &concealed;
  codec->thread_count = 0;  // as many as there are; decoding is exact
  if (const int error = avcodec_open2(codec.get(), decoder, nullptr); error < 0)
    fail(file, "cannot decode", error);
  packet = allocated<Packet>(av_packet_alloc());
  frame = allocated<VideoFrame>(av_frame_alloc());
}

// One packet of the video, or the end, into the decoder.
void VideoReader::State::feed() {
  for (;;) {
    const int result = av_read_frame(demuxer.get(), packet.get());
    if (result < 0 && result != AVERROR_EOF) fail(file, "frame " + std::to_string(decoded), result);
    const bool ours = result == 0 && packet->stream_index == stream;
    int sent = 0;
    if (result == AVERROR_EOF) {
      sent = avcodec_send_packet(codec.get(), nullptr);
    } else if (ours) {
      sent = avcodec_send_packet(codec.get(), packet.get());
    }
    av_packet_unref(packet.get());
    if (sent < 0) fail(file, "frame " + std::to_string(decoded) + " is damaged", sent);
    if (ours || result == AVERROR_EOF) return;
  }
}

std::optional<EncodedMap> VideoReader::State::next() {
  for (;;) {
    const int result = avcodec_receive_frame(codec.get(), frame.get());
    if (result == 0) {
      if (concealed > 0 || frame->decode_error_flags != 0 || (frame->flags & AV_FRAME_FLAG_CORRUPT) != 0) {
        throw InputError(file.string(),
                         "the video is damaged at or soon after frame " + std::to_string(decoded));
      }
      ++decoded;
      return toRgb();
    }
    if (result == AVERROR_EOF) break;
    if (result != AVERROR(EAGAIN)) fail(file, "frame " + std::to_string(decoded) + " is damaged", result);
    feed();
  }
  if (concealed > 0 || decoded < frameCount) {
    throw InputError(file.string(), "the video is damaged: expected " + std::to_string(frameCount) +
                                        " frames, could decode " + std::to_string(decoded));
  }
  return std::nullopt;
}

EncodedMap VideoReader::State::toRgb() {
  if (Size{frame->width, frame->height} != size) {
    throw InputError(file.string(),
                     "frame " + std::to_string(decoded - 1) + " changes the size of the picture");
  }
  const auto pixelFormat = static_cast<AVPixelFormat>(frame->format);
  constexpr int kFlags =
      SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT;
  scaler = Scaler(sws_getCachedContext(scaler.release(), size.width, size.height, pixelFormat, size.width,
                                       size.height, AV_PIX_FMT_RGB24, kFlags, nullptr, nullptr, nullptr));
  if (!scaler) throw InputError(file.string(), "cannot convert its pixel format to RGB");
  const int fullRange = frame->color_range == AVCOL_RANGE_JPEG ? 1 : 0;
  // Refused for formats that are RGB already, which is as it should be.
  (void)sws_setColorspaceDetails(scaler.get(), sws_getCoefficients(matrixOf(*frame)), fullRange,
                                 sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);

  // swscale's vector code writes whole blocks: rows need room behind them.
  const int stride = (3 * size.width + 127) / 64 * 64;
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(stride) * static_cast<std::size_t>(size.height) +
                                64);
  const std::array<std::uint8_t*, 4> planes{rgb.data(), nullptr, nullptr, nullptr};
  const std::array<int, 4> strides{stride, 0, 0, 0};
  const int rows =
      sws_scale(scaler.get(), frame->data, frame->linesize, 0, size.height, planes.data(), strides.data());
  if (rows != size.height) throw InputError(file.string(), "cannot convert its pixel format to RGB");
  EncodedMap image(size);
  for (int y = 0; y < size.height; ++y) {
    const std::uint8_t* in = rgb.data() + static_cast<std::ptrdiff_t>(y) * stride;
    for (Rgb& code : image.row(y)) {
      code = Rgb(static_cast<float>(in[0]), static_cast<float>(in[1]), static_cast<float>(in[2])) / 255.0f;
      in += 3;
    }
  }
  return image;
}

VideoReader::VideoReader(const fs::path& file) : state_(std::make_unique<State>(file)) {}
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;
VideoReader::~VideoReader() = default;

Size VideoReader::size() const {
  return state_->size;
}
FrameRate VideoReader::frameRate() const {
  return state_->frameRate;
}
int VideoReader::frameCount() const {
  return state_->frameCount;
}
std::optional<EncodedMap> VideoReader::next() {
  return state_->next();
}

}  // namespace promenade::io
