#include "app/merge/weights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"

namespace pssmlt {
namespace {

RenderRecord record(const std::string& technique, const std::string& seed, double samples,
                    std::optional<RelativeError> error = std::nullopt) {
  RenderRecord r;
  r.scene = "scene.txt";
  r.scene_hash = "1";
  r.picture_hash = "2";
  r.integrator = technique;
  r.sampler = "s";
  r.parts = {{technique, seed}};
  r.samples = samples;
  r.seconds = 1.0;
  r.error = error;
  return r;
}

RelativeError relative(double value) { return {value, value / 1.5, value * 1.5}; }

using Records = std::vector<RenderRecord>;

TEST(MergeWeights, OneTechniqueCountsBySamples) {
  const std::vector<double> w =
      merge_weights(Records{record("a", "1", 100.0), record("a", "2", 300.0, relative(9.0))});
  EXPECT_DOUBLE_EQ(w[0], 0.25);
  EXPECT_DOUBLE_EQ(w[1], 0.75);
}

TEST(MergeWeights, TechniquesCountByInverseError) {
  const std::vector<double> w = merge_weights(
      Records{record("a", "1", 1e6, relative(0.3)), record("b", "2", 10.0, relative(0.1))});
  EXPECT_NEAR(w[0], 0.25, 1e-12);
  EXPECT_NEAR(w[1], 0.75, 1e-12);
}

// Two of technique a with 1 : 3 samples and errors 0.4 and 0.2: together 0.4 / 16 + 0.2 * 9 / 16 =
// 0.1375; b has 0.0275, a fifth: weights 1/6 and 5/6.
TEST(MergeWeights, EachTechniqueIsOneEstimate) {
  const std::vector<double> w = merge_weights(Records{record("a", "1", 1.0, relative(0.4)),
                                                      record("b", "1", 7.0, relative(0.0275)),
                                                      record("a", "2", 3.0, relative(0.2))});
  EXPECT_NEAR(w[0], 0.25 / 6.0, 1e-12);
  EXPECT_NEAR(w[1], 5.0 / 6.0, 1e-12);
  EXPECT_NEAR(w[2], 0.75 / 6.0, 1e-12);
}

// No other weights give a smaller sum of w^2 e.
TEST(MergeWeights, InverseErrorsAreBest) {
  const Records records = {record("a", "1", 5.0, relative(0.3)),
                           record("b", "2", 6.0, relative(0.07))};
  const std::vector<double> best = merge_weights(records);
  const double least = merged_error(records, best)->value;
  for (const double d : {-0.2, -0.01, 0.01, 0.1}) {
    const std::vector<double> other = {best[0] + d, best[1] - d};
    EXPECT_GT(merged_error(records, other)->value, least);
  }
}

TEST(MergeWeights, UnknownErrorsOfTechniquesAreRefused) {
  EXPECT_THROW(merge_weights(Records{record("a", "1", 1.0), record("b", "1", 1.0, relative(0.1))}),
               Error);
  EXPECT_THROW(merge_weights(Records{record("a", "1", 1.0, relative(0.0)),
                                     record("b", "1", 1.0, relative(0.1))}),
               Error);
}

// Equal weights, equal estimates e with interval e / 1.5 to e * 1.5: half the error, and the
// interval's logarithm is shorter by sqrt(2).
TEST(MergeWeights, ErrorByHand) {
  const Records records = {record("a", "1", 1.0, relative(0.2)),
                           record("a", "2", 1.0, relative(0.2))};
  const RelativeError e = *merged_error(records, std::vector<double>{0.5, 0.5});
  EXPECT_NEAR(e.value, 0.1, 1e-12);
  EXPECT_NEAR(e.high / e.value, std::exp(std::log(1.5) / std::sqrt(2.0)), 1e-9);
  EXPECT_NEAR(e.value / e.low, e.high / e.value, 1e-9);
  EXPECT_FALSE(merged_error(Records{record("a", "1", 1.0)}, std::vector<double>{1.0}));
}

TEST(MergeWeights, MergesOfMergesAreMerges) {
  const RenderRecord a = record("a", "1", 100.0, relative(0.3)),
                     b = record("a", "2", 200.0, relative(0.15)),
                     c = record("a", "3", 500.0, relative(0.06));
  const Records all = {a, b, c}, two = {a, b};
  const std::vector<double> w = merge_weights(all), v = merge_weights(two);
  const RenderRecord ab = merged_record(two, v, true);
  EXPECT_NEAR(ab.samples, 300.0, 1e-9);
  EXPECT_EQ(ab.seconds, 2.0);
  const Records rest = {ab, c};
  const std::vector<double> u = merge_weights(rest);
  EXPECT_NEAR(u[0] * v[0], w[0], 1e-12);
  EXPECT_NEAR(u[0] * v[1], w[1], 1e-12);
  EXPECT_NEAR(u[1], w[2], 1e-12);
  const RenderRecord once = merged_record(all, w, true), twice = merged_record(rest, u, true);
  EXPECT_NEAR(once.samples, twice.samples, 1e-9);
  EXPECT_NEAR(once.error->value, twice.error->value, 1e-12);
  EXPECT_NEAR(once.error->high, twice.error->high, 1e-12);
  EXPECT_EQ(once.parts, twice.parts);
  EXPECT_TRUE(twice.one_technique());
  EXPECT_TRUE(share_numbers(twice, b));
  EXPECT_FALSE(share_numbers(ab, c));
}

TEST(MergeWeights, MixedRecordsAreATechniqueOfTheirOwn) {
  const Records two = {record("a", "1", 100.0, relative(0.2)),
                       record("b", "1", 50.0, relative(0.2))};
  const RenderRecord mixed = merged_record(two, merge_weights(two), true);
  EXPECT_FALSE(mixed.one_technique());
  EXPECT_EQ(mixed.samples, 150.0);
  EXPECT_NEAR(mixed.error->value, 0.1, 1e-12);
  EXPECT_EQ(mixed.integrator, "a, b");
  EXPECT_EQ(mixed.sampler, "s");
  const std::vector<double> w = merge_weights(Records{mixed, record("a", "7", 1e9, relative(0.3))});
  EXPECT_NEAR(w[0], 0.75, 1e-12);
}

// Weights that are not by samples make fewer samples' worth: 2 : 1 on equal ones.
TEST(MergeWeights, SamplesAreWorthTheirVariance) {
  const Records two = {record("a", "1", 90.0), record("a", "2", 90.0)};
  const RenderRecord merged = merged_record(two, std::vector<double>{2.0 / 3.0, 1.0 / 3.0}, true);
  EXPECT_NEAR(merged.samples, 90.0 * 9.0 / 5.0, 1e-9);
  EXPECT_FALSE(merged_record(two, std::vector<double>{0.5, 0.5}, false).error);
}

TEST(MergeRecord, MetadataKeepEverything) {
  const Records two = {record("aa", "1", 100.0, relative(0.25)),
                       record("bb", "18446744073709551615", 50.0, relative(0.25))};
  const RenderRecord merged = merged_record(two, std::vector<double>{0.5, 0.5}, true);
  for (const RenderRecord& r : {two[0], two[1], merged}) {
    const std::optional<RenderRecord> back = read_record(to_metadata(r));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->parts, r.parts);
    EXPECT_EQ(back->scene, r.scene);
    EXPECT_EQ(back->scene_hash, r.scene_hash);
    EXPECT_EQ(back->picture_hash, r.picture_hash);
    EXPECT_EQ(back->integrator, r.integrator);
    EXPECT_EQ(back->samples, r.samples);
    EXPECT_EQ(back->seconds, r.seconds);
    ASSERT_TRUE(back->error);
    EXPECT_NEAR(back->error->value, r.error->value, 1e-5 * r.error->value);
    EXPECT_NEAR(back->error->low, r.error->low, 1e-5 * r.error->low);
  }
}

TEST(MergeRecord, WhatIsMissingOrBrokenIsNoRecord) {
  const ImageMetadata good = to_metadata(record("a", "1", 100.0, relative(0.25)));
  ASSERT_TRUE(read_record(good));
  EXPECT_FALSE(read_record({}));
  for (const char* key : {"pssmlt:scene_hash", "pssmlt:picture_hash", "pssmlt:settings_hash",
                          "pssmlt:seed", "pssmlt:samples"}) {
    ImageMetadata without = good;
    std::erase_if(without, [&](const auto& entry) { return entry.first == key; });
    EXPECT_FALSE(read_record(without)) << key;
  }
  const auto with = [&](const std::string& key, const std::string& value) {
    ImageMetadata changed = good;
    for (auto& [name, text] : changed) {
      if (name == key) text = value;
    }
    return read_record(changed);
  };
  for (const char* bad : {"", "x", "-5", "0", "nan", "inf", "1e999", "10 samples"}) {
    EXPECT_FALSE(with("pssmlt:samples", bad)) << bad;
  }
  for (const char* bad : {"", "unknown", "relMSE x (1 to 2)", "relMSE 1 (3 to 2)", "relMSE 1"}) {
    ASSERT_TRUE(with("pssmlt:error", bad)) << bad;
    EXPECT_FALSE(with("pssmlt:error", bad)->error) << bad;
  }
  ImageMetadata merged = good;
  merged.emplace_back("pssmlt:merged", "nonsense");
  EXPECT_FALSE(read_record(merged));
}

}  // namespace
}  // namespace pssmlt
