#include "src/render/library_version.h"

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace promenade::render {

std::string embreeVersion() {
  const std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)> device(
      rtcNewDevice("threads=1"), &rtcReleaseDevice);
  const auto number = [&](RTCDeviceProperty property) {
    return std::to_string(rtcGetDeviceProperty(device.get(), property));
  };
  return number(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + number(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." +
         number(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

}  // namespace promenade::render
