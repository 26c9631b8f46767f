#include "src/walkthrough/adaptation_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace promenade::walkthrough {
namespace {

using Json = nlohmann::json;

// The shares of the bins from `first` on.
std::optional<LightHistogram> histogramFrom(const Json& first, const Json& shares) {
  constexpr int kBins = LightHistogram::kBins;
  if (!first.is_number_integer() || !shares.is_array() || shares.empty()) return std::nullopt;
  const int begin = first.get<int>();
  if (begin < 0 || begin >= kBins || shares.size() > static_cast<std::size_t>(kBins - begin)) {
    return std::nullopt;
  }
  LightHistogram histogram;
  histogram.shares.assign(kBins, 0.0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double share = shares[i].is_number() ? shares[i].get<double>() : -1.0;
    if (!(share >= 0.0 && share <= 1.0 + 1e-9)) return std::nullopt;
    histogram.shares[static_cast<std::size_t>(begin) + i] = share;
  }
  return histogram;
}

std::optional<View> viewFrom(const Json& entry) {
  if (!entry.is_array() || (entry.size() != 2 && entry.size() != 4)) return std::nullopt;
  if (!entry[0].is_number_integer() || !entry[1].is_number()) return std::nullopt;
  View view{entry[0].get<int>(), entry[1].get<double>()};
  if (view.frame < 0 || view.frame >= 1'000'000 || !std::isfinite(view.luminance)) return std::nullopt;
  if (entry.size() == 2) return view;
  std::optional<LightHistogram> histogram = histogramFrom(entry[2], entry[3]);
  if (!histogram) return std::nullopt;
  view.histogram = std::move(*histogram);
  return view;
}

}  // namespace

nlohmann::ordered_json adaptationJson(const ToneMapping& tone) {
  using Ordered = nlohmann::ordered_json;
  if (tone.adaptation.views().empty()) return Ordered();
  const auto hasLight = [](double share) { return share > 0.0; };
  Ordered views = Ordered::array();
  for (const View& view : tone.adaptation.views()) {
    Ordered entry = Ordered::array({view.frame, view.luminance});
    const std::vector<double>& shares = view.histogram.shares;
    const auto first = std::find_if(shares.begin(), shares.end(), hasLight);
    if (tone.curve == ToneCurve::kLarson && first != shares.end()) {
      const auto last = std::find_if(shares.rbegin(), shares.rend(), hasLight).base();
      entry.push_back(first - shares.begin());
      entry.push_back(std::vector<double>(first, last));
    }
    views.push_back(std::move(entry));
  }
  return views;
}

std::optional<AdaptationCurve> adaptationFrom(const Json& value, double framesPerSecond) {
  if (value.is_null()) return AdaptationCurve();
  if (!value.is_array() || value.empty() || !(framesPerSecond > 0.0)) return std::nullopt;
  std::vector<View> views;
  for (const Json& entry : value) {
    std::optional<View> view = viewFrom(entry);
    if (!view || (!views.empty() && view->frame <= views.back().frame)) return std::nullopt;
    views.push_back(std::move(*view));
  }
  return AdaptationCurve(std::move(views), framesPerSecond);
}

}  // namespace promenade::walkthrough
