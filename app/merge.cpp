// pssmlt merge: the average of independent renders of one picture.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <numeric>

#include "app/merge/merge_images.h"
#include "app/merge/weights.h"
#include "app/metrics/metrics.h"
#include "app/parse_arguments.h"
#include "core/base/log.h"
#include "core/image/image_file.h"

namespace pssmlt {
namespace {

struct MergeOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::vector<double> weights;  // empty: from the files
  bool force = false;
};

struct Input {
  std::string path;
  std::optional<RenderRecord> record;
};
struct Inputs {
  std::vector<Input> files;
  std::vector<Image> images;
};

// False: help was printed.
bool parse(const Arguments& arguments, MergeOptions& o) {
  CLI::App app(
      "Averages independent renders of one picture. Renders of one technique count by their "
      "numbers\n"
      "of samples, techniques among each other by the inverse of their estimated errors.",
      "pssmlt merge");
  app.add_option("images", o.inputs, "renders, with their metadata (exr)")
      ->required()
      ->expected(2, 100000);
  app.add_option("-o,--output", o.output, "output (exr, pfm, hdr, png, jpg)")->required();
  app.add_option("--weights", o.weights, "weights instead, in proportion: w1,w2,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_flag("--force", o.force, "merge even if renders share their random numbers");
  if (!parse_arguments(app, arguments)) return false;
  if (!o.weights.empty() && o.weights.size() != o.inputs.size()) {
    throw Error(
        fmt::format("--weights: {} numbers for {} images", o.weights.size(), o.inputs.size()));
  }
  for (const double w : o.weights) {
    if (!(std::isfinite(w) && w > 0.0)) throw Error("--weights: numbers above 0 are expected");
  }
  check_writable(o.output);
  return true;
}

Inputs read_inputs(const MergeOptions& o) {
  Inputs inputs;
  for (const std::string& path : o.inputs) {
    const ImageFile file = read_image_file(path);
    inputs.files.push_back({path, read_record(file.metadata)});
    inputs.images.push_back(decode_image(file, ""));
    const Image &first = inputs.images.front(), &last = inputs.images.back();
    if (last.width != first.width || last.height != first.height) {
      throw Error(fmt::format("{} has {} x {} pixels, {} has {} x {}", o.inputs.front(),
                              first.width, first.height, path, last.width, last.height));
    }
    if (!inputs.files.back().record && o.weights.empty()) {
      throw Error(path +
                  " does not say how it was rendered (pssmlt:samples and others are missing): "
                  "give the images' weights with --weights w1,w2,...");
    }
  }
  return inputs;
}

void check_pair(const Input& a, const Input& b, bool force) {
  if (!a.record || !b.record) return;
  if (a.record->scene_hash != b.record->scene_hash) {
    throw Error(fmt::format("{} and {} are renders of different scenes ({} and {})", a.path, b.path,
                            a.record->scene, b.record->scene));
  }
  if (a.record->picture_hash != b.record->picture_hash) {
    throw Error(
        fmt::format("{} and {} do not show the same: window, path lengths or other "
                    "settings of the scene differ",
                    a.path, b.path));
  }
  if (share_numbers(*a.record, *b.record)) {
    const std::string what = fmt::format(
        "{} and {} hold renders of the same technique from the same seed: they are not independent",
        a.path, b.path);
    if (!force) throw Error(what + "; render with another --seed, or give --force");
    log_warning(what);
  } else if (share_seeds(*a.record, *b.record)) {
    log_warning(
        fmt::format("{} and {} come from the same seed: techniques that read the same "
                    "numbers are not independent, and the error stated is too small",
                    a.path, b.path));
  }
}

// Throws Error for what must not be averaged; false if some of the renders are not independent.
bool check_inputs(const std::vector<Input>& inputs, bool force) {
  bool independent = true;
  for (size_t i = 0; i < inputs.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      check_pair(inputs[j], inputs[i], force);
      independent = independent && !(inputs[i].record && inputs[j].record &&
                                     share_numbers(*inputs[i].record, *inputs[j].record));
    }
  }
  return independent;
}

// All of the records, or none if one is missing.
std::vector<RenderRecord> records_of(const std::vector<Input>& inputs) {
  std::vector<RenderRecord> records;
  for (const Input& i : inputs) {
    if (!i.record) return {};
    records.push_back(*i.record);
  }
  return records;
}

std::vector<double> choose_weights(const MergeOptions& o,
                                   const std::vector<RenderRecord>& records) {
  if (!o.weights.empty()) {
    const double sum = std::accumulate(o.weights.begin(), o.weights.end(), 0.0);
    std::vector<double> weights = o.weights;
    for (double& w : weights) w /= sum;
    return weights;
  }
  try {
    return merge_weights(records);
  } catch (const Error& error) {
    throw Error(std::string(error.what()) + ": give the images' weights with --weights w1,w2,...");
  }
}

// The distance of each render from the average is what their errors add up to: much more means that
// they do not agree, whatever the metadata say (a technique may not see all light).
void warn_of_disagreement(const Inputs& inputs, std::span<const RenderRecord> records,
                          std::span<const double> weights, const Image& merged) {
  constexpr double too_much = 3.0;
  const std::vector<std::string> metric = {"relmse"};
  for (size_t i = 0; i < records.size(); ++i) {
    double expected = 0.0;
    for (size_t j = 0; j < records.size(); ++j) {
      if (!records[j].error) return;
      const double share = i == j ? 1.0 - weights[j] : weights[j];
      expected += share * share * records[j].error->high;
    }
    const double found =
        compare_images(inputs.images[i], merged, metric).values[metric_index(metric.front())];
    if (found <= too_much * expected) continue;
    log_warning(
        fmt::format("{} differs from the others by more than its error explains (relMSE "
                    "{:.3g}, expected {:.3g}): the renders may not show the same light",
                    inputs.files[i].path, found, expected));
  }
}

void merge(const MergeOptions& o) {
  const Inputs inputs = read_inputs(o);
  const bool independent = check_inputs(inputs.files, o.force);
  const std::vector<RenderRecord> records = records_of(inputs.files);
  const std::vector<double> weights = choose_weights(o, records);
  const MergedImage merged = merge_images(inputs.images, weights, independent);
  for (size_t i = 0; i < weights.size(); ++i) {
    log_info(fmt::format("{}: weight {:.6g}", inputs.files[i].path, weights[i]));
  }
  for (const std::string& layer : merged.left_out) log_info("left out: layer " + layer);
  ImageMetadata metadata = {{"software", "pssmlt " PSSMLT_VERSION}};
  if (!records.empty()) {
    if (independent) warn_of_disagreement(inputs, records, weights, merged.image);
    const RenderRecord record = merged_record(records, weights, independent);
    metadata = to_metadata(record);
    if (record.error) {
      log_info(fmt::format("estimated relMSE {:.3g} ({:.3g} to {:.3g})", record.error->value,
                           record.error->low, record.error->high));
    }
  }
  write_image(o.output, merged.image, metadata, {});
  log_info("wrote " + o.output);
}

}  // namespace

int run_merge(const Arguments& arguments) {
  MergeOptions options;
  if (parse(arguments, options)) merge(options);
  return 0;
}

}  // namespace pssmlt
