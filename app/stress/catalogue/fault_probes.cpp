#include <nlohmann/json.hpp>

#include "app/stress/catalogue/probes.h"
#include "app/stress/catalogue/scenes.h"
#include "app/stress/oracle.h"
#include "app/stress/picture.h"
#include "app/stress/process.h"
#include "app/stress/technique.h"

namespace pssmlt::stress {
namespace {

Outcome pass(const std::string& seen) { return {.verdict = Verdict::pass, .reason = seen}; }
Outcome failed(const std::string& what, const ProcessResult& result) {
  return {.verdict = Verdict::fail,
          .reason = fmt::format("{}: exit code {}, \"{}\"", what, result.exit_code,
                                result.text.substr(0, 400))};
}

bool says(const ProcessResult& result, const std::string& text) {
  return result.text.find(text) != std::string::npos;
}

// A lamp above a plane; `picture` of width x height pixels.
std::string simple_scene(int width, int height, const std::string& material) {
  return fmt::format(R"(
Film "rgb" "integer xresolution" {} "integer yresolution" {} "string filename" "out.pfm"
LookAt 0 0 4  0 0 0  0 1 0
Camera "perspective"
Sampler "sobol" "integer pixelsamples" 8
WorldBegin
LightSource "point" "rgb I" [ 3 3 3 ] "point3 from" [ 0 0 1.5 ]
{}
Shape "disk" "float radius" 2
)",
                     width, height, material);
}

}  // namespace

Outcome throwing_integrator(const ProbeContext& context) {
  Job job{.scene = film(16, 16) +
                   "Camera \"perspective\"\nIntegrator \"stress_throws\"\nWorldBegin\n"
                   "LightSource \"point\"\nShape \"sphere\"\n",
          .pair = {"", context.pair.sampler},
          .set = small_settings({"", context.pair.sampler}),
          .threads = context.threads};
  Picture picture(job);
  picture.add(1024);
  const double expected[] = {1.0};
  const Blocks blocks = picture.blocks();
  const Comparison c = compare_means(blocks, expected, 3e-3, context.false_alarm);
  const RenderFigures figures = picture.figures();
  Outcome o;
  o.deviation = c.deviation;
  o.tolerance = c.tolerance;
  o.meaning = meaning_of(blocks, context.false_alarm);
  o.dropped = figures.dropped;
  o.acceptance = figures.acceptance;
  o.longest_stuck = figures.longest_stuck;
  o.reason = figures.causes;
  const bool counted = figures.causes.find("exception") != std::string::npos &&
                       figures.causes.find("integrator \"stress_throws\"") != std::string::npos;
  o.verdict = c.holds && counted ? Verdict::pass : Verdict::fail;
  return o;
}

Outcome memory_exhausted(const ProbeContext& context) {
  const WorkFolder folder;
  folder.write("scene.txt", simple_scene(19000, 19000, ""));
  const ProcessResult r = run_script(folder, context.program,
                                     "ulimit -v 2000000\n\"$PSSMLT\" render scene.txt --spp 1");
  if (r.exit_code != 1 || !says(r, "memory")) return failed("2 GB of address space", r);
  if (std::filesystem::exists(folder.path() / "out.pfm")) return failed("a picture is left", r);
  return pass("exit code 1, \"out of memory\"");
}

// A limit of the size of files, with its signal ignored, makes writes fail as a full disk does.
Outcome disk_full(const ProbeContext& context) {
  const WorkFolder folder;
  folder.write("scene.txt", simple_scene(256, 256, ""));
  const ProcessResult r = run_script(
      folder, context.program, "trap '' XFSZ\nulimit -f 64\n\"$PSSMLT\" render scene.txt --spp 2");
  if (r.exit_code != 1 || !says(r, "out.pfm")) return failed("files of 32 kB at most", r);
  if (std::filesystem::exists(folder.path() / "out.pfm"))
    return failed("half a picture is left", r);
  return pass("exit code 1, the file is named, no half of a picture");
}

Outcome checkpoint_on_full_disk(const ProbeContext& context) {
  const WorkFolder folder;
  folder.write("scene.txt", simple_scene(64, 64, ""));
  const std::string render = "\"$PSSMLT\" render scene.txt ";
  const ProcessResult r =
      run_script(folder, context.program,
                 render + "--spp 16 -o whole.pfm || exit 51\n" + render +
                     "--spp 8 -o part.pfm --checkpoint state || exit 52\ncp state before\n"
                     "(trap '' XFSZ; ulimit -f 16; " +
                     render +
                     "--spp 12 -o part.pfm --checkpoint state --resume)\n"
                     "cmp state before || exit 53\n" +
                     render +
                     "--spp 16 -o part.pfm --checkpoint state --resume || exit 54\n"
                     "cmp whole.pfm part.pfm || exit 55");
  if (r.exit_code != 0) return failed("checkpoints on a full disk", r);
  return pass("the checkpoint before is whole and resumes to the same bits");
}

Outcome texture_vanishes(const ProbeContext& context) {
  const WorkFolder folder;
  folder.write("plain.txt", simple_scene(64, 64, ""));
  folder.write("scene.txt",
               simple_scene(64, 64,
                            "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" "
                            "\"texture.pfm\"\nMaterial \"diffuse\" \"texture reflectance\" "
                            "\"t\""));
  const std::string render = "\"$PSSMLT\" render scene.txt --spp 400 --quiet ";
  const ProcessResult r = run_script(
      folder, context.program,
      "\"$PSSMLT\" render plain.txt --spp 1 --quiet -o texture.pfm || exit 51\ncp texture.pfm "
      "copy\n" +
          render +
          "-o whole.pfm || exit 52\n"
          // The first checkpoint says that rendering has begun.
          "(while [ ! -e state ]; do sleep .02; done; rm texture.pfm) &\n" +
          render +
          "--texture-cache 64kB --checkpoint state --checkpoint-every 100ms -o part.pfm || "
          "exit 53\nwait\n[ ! -e texture.pfm ] || exit 54\n"
          "cmp whole.pfm part.pfm || exit 55");
  if (r.exit_code != 0) return failed("a texture's file that vanishes", r);
  return pass("the same picture");
}

Outcome integrator_throws_early(const ProbeContext& context) {
  const WorkFolder folder;
  folder.write("scene.txt", simple_scene(16, 16, ""));
  const ProcessResult r =
      run_script(folder, context.program,
                 "export PSSMLT_PLUGIN_PATH=\"$(dirname \"$(readlink -f \"$PSSMLT\")\")\"/../lib/"
                 "pssmlt/stress\n\"$PSSMLT\" render scene.txt --integrator stress_throws --set "
                 "integrator.prepare=true");
  if (r.exit_code != 1 || !says(r, "thrown on purpose")) return failed("prepare() throws", r);
  return pass("exit code 1 and the plugin's message");
}

}  // namespace pssmlt::stress
