#include "src/walkthrough/adaptation_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace promenade::walkthrough {
namespace {

using nlohmann::json;

ToneMapping toneOf(ToneCurve curve) {
  ToneMapping tone;
  tone.curve = curve;
  tone.adaptation = AdaptationCurve(
      {viewOf(2, {1.0, 3.3, 70.0}, 0.7), viewOf(6, {0.1, 5.0}, 0.7), viewOf(7, {0.1, 0.3}, 0.7)}, 30.0);
  return tone;
}

TEST(AdaptationJson, ComesBackExactly) {
  for (const ToneCurve curve : {ToneCurve::kWard, ToneCurve::kLarson}) {
    const ToneMapping tone = toneOf(curve);
    const auto back = adaptationFrom(json::parse(adaptationJson(tone).dump()), 30.0);
    ASSERT_TRUE(back.has_value());
    for (int frame = 0; frame < 10; ++frame) {
      EXPECT_EQ(back->at(frame).now, tone.adaptation.at(frame).now) << frame;
      EXPECT_EQ(back->at(frame).steady, tone.adaptation.at(frame).steady) << frame;
    }
    if (curve != ToneCurve::kLarson) continue;
    EXPECT_EQ(back->histogramAt(5).shares, tone.adaptation.histogramAt(5).shares);
  }
}

TEST(AdaptationJson, OfNothingIsNull) {
  EXPECT_TRUE(adaptationJson(ToneMapping{}).is_null());
  ASSERT_TRUE(adaptationFrom(json(), 25.0).has_value());
  EXPECT_TRUE(adaptationFrom(json(), 25.0)->views().empty());
}

TEST(AdaptationJson, ThatIsDamagedIsNothing) {
  for (const char* text : {"[]", "3", "[3]", "[[0]]", "[[0, \"a\"]]", "[[-1, 2.0]]", "[[5, 1.0], [5, 1.0]]",
                           "[[0, 1.0, 3]]", "[[0, 1.0, 3, []]]", "[[0, 1.0, 240, [0.5, 0.5]]]",
                           "[[0, 1.0, 3, [-0.5]]]", "[[0, 1.0, -1, [1.0]]]", "[[2000000, 1.0]]"}) {
    EXPECT_FALSE(adaptationFrom(json::parse(text), 25.0).has_value()) << text;
  }
  EXPECT_FALSE(adaptationFrom(json::parse("[[0, 1.0]]"), 0.0).has_value());
}

}  // namespace
}  // namespace promenade::walkthrough
