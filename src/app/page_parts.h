#pragma once
// The files of src/app/report and the chart library, as the build found them: the program needs no folder of
// data beside it.

#include <string_view>

namespace promenade::app {

/// page.html, with {{title}}, {{style}}, {{data}}, {{charts}} and {{script}} where those go.
[[nodiscard]] std::string_view pageTemplate();
[[nodiscard]] std::string_view pageStyle();
[[nodiscard]] std::string_view pageScript();
/// Chart.js, minified (Debian's libjs-chart.js; MIT licence).
[[nodiscard]] std::string_view chartLibrary();

}  // namespace promenade::app
