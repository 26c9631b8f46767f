#include "src/io/libav_internal.h"

#include <array>
#include <cstdarg>

namespace promenade::io {

namespace {

void countDecoderErrors(void* context, int level, const char* /*format*/, va_list /*arguments*/) {
  if (context == nullptr || level > AV_LOG_ERROR) return;
  // Whatever logs begins with a pointer to its class.
  if (*static_cast<const AVClass* const*>(context) != avcodec_get_class()) return;
  auto* errors = static_cast<ErrorCount*>(static_cast<AVCodecContext*>(context)->opaque);
  if (errors != nullptr) ++*errors;
}

}  // namespace

void redirectLibavLog() {
  av_log_set_callback(countDecoderErrors);
}

std::string libavMessage(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

}  // namespace promenade::io
