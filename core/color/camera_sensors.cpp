#include "core/color/camera_sensors.h"

#include <array>
#include <glm/matrix.hpp>

#include "core/color/color_space.h"
#include "core/color/spectrum.h"

namespace pssmlt {
namespace {

struct Camera {
  std::string_view name;
  std::array<double, 9> rows;  // of the matrix
  double rms, worst;           // of its error, see CameraSensor
};

// The curves of red, green and blue, every 10 nm from 380 to 720 nm, are the measurements that
// pbrt-v4 publishes for the sensors of Langlands and Fascione ("PhysLight: an end-to-end pipeline
// for scene-referred lighting", SIGGRAPH 2020 talks). A camera's colours go to XYZ by the matrix
// that is best, by least squares, for the 24 patches of a colour chart lit by daylight of 6500 K;
// that is why white is not exactly (1, 1, 1). The matrices here are fits of all this over a grid of
// 8^3 colours, even in the code values of sRGB, each with the smooth reflectance of Jakob and
// Hanika (2019) lit by D65: least squares with weights 1 / (luminance * largest component), white
// exact. Root mean squares of the error of luminance and of the components, relative to luminance
// and to the largest component, mean over the cameras: 10.5 and 3.3 %; weighted by the largest
// component alone 19 and 3.1 %, by luminance alone 7 and 3.6 %, with no more than white 41 and
// 4.0 %. Of colours whose smallest component is above a fifth of the largest: 1.4 and 1.3 %, with
// no more than white 3.1 and 2.2 %.
constexpr std::array<Camera, 17> cameras = {{
    {"canon_eos_100d",
     {1.05931, -0.05145, -0.01945, 0.00887, 1.04362, -0.06087, 0.01848, 0.02179, 0.95630},
     0.037,
     0.34},
    {"canon_eos_1dx_mkii",
     {1.02573, -0.02944, -0.00164, 0.01342, 1.04488, -0.06677, 0.01501, 0.04315, 0.93373},
     0.026,
     0.13},
    {"canon_eos_200d",
     {1.05378, -0.06302, 0.00116, 0.01342, 1.05792, -0.08273, 0.01768, 0.01588, 0.96485},
     0.038,
     0.32},
    {"canon_eos_200d_mkii",
     {1.03692, -0.04871, 0.00574, 0.01572, 1.05529, -0.08176, 0.01352, 0.02671, 0.95485},
     0.030,
     0.20},
    {"canon_eos_5d",
     {1.07162, -0.04478, -0.04480, 0.01387, 0.99988, -0.01696, 0.00325, 0.11130, 0.86765},
     0.053,
     0.48},
    {"canon_eos_5d_mkii",
     {1.04545, -0.04171, -0.01453, 0.01232, 1.02689, -0.04543, 0.01041, 0.06302, 0.91704},
     0.033,
     0.27},
    {"canon_eos_5d_mkiii",
     {1.04077, -0.02990, -0.01985, 0.01025, 1.03147, -0.04817, 0.01500, 0.05284, 0.92287},
     0.030,
     0.21},
    {"canon_eos_5d_mkiv",
     {1.03851, -0.04090, -0.00589, 0.01621, 1.03684, -0.06000, 0.00724, 0.07785, 0.89991},
     0.035,
     0.25},
    {"canon_eos_5ds",
     {1.05487, -0.05395, -0.01179, 0.01657, 1.04075, -0.06541, 0.00806, 0.06390, 0.91599},
     0.040,
     0.38},
    {"canon_eos_m",
     {1.06743, -0.05441, -0.02644, 0.00857, 1.04414, -0.06124, 0.01893, 0.01903, 0.95972},
     0.041,
     0.38},
    {"hasselblad_l1d_20c",
     {1.03157, -0.00017, -0.04616, 0.01633, 1.03132, -0.05394, 0.00682, 0.08367, 0.89430},
     0.034,
     0.21},
    {"nikon_d810",
     {1.02214, 0.02366, -0.06017, 0.01291, 1.00269, -0.01949, 0.00483, 0.09026, 0.89012},
     0.031,
     0.14},
    {"nikon_d850",
     {1.03497, 0.00884, -0.05934, 0.01503, 1.01513, -0.03477, 0.00579, 0.10324, 0.87358},
     0.037,
     0.16},
    {"sony_ilce_6400",
     {1.02475, 0.00660, -0.04138, 0.00154, 1.03031, -0.03850, 0.02552, 0.00925, 0.96780},
     0.026,
     0.23},
    {"sony_ilce_7m3",
     {1.02481, 0.00445, -0.03941, 0.00891, 1.01848, -0.03423, 0.01963, 0.02483, 0.95412},
     0.023,
     0.14},
    {"sony_ilce_7rm3",
     {1.02569, 0.00730, -0.04465, 0.01015, 1.01376, -0.02973, 0.01508, 0.04031, 0.93955},
     0.023,
     0.14},
    {"sony_ilce_9",
     {1.02425, -0.00794, -0.02155, 0.00636, 1.02823, -0.04411, 0.03036, -0.01467, 0.99356},
     0.031,
     0.35},
}};

// Rows are the receptors in which one gain each does best what the cameras' least squares do for
// another light (Finlayson, Drew and Funt, "Spectral sharpening", JOSA A 11(5), 1994): the
// eigenvectors of the map from the chart under 4300 K to the chart under D65, as the standard
// observer sees both. All are positive on whites from 1000 K on. Of XYZ.
const glm::dmat3& receptors() {
  static const glm::dmat3 matrix =
      glm::transpose(glm::dmat3(dvec3(0.6573, -0.2534, -0.0893), dvec3(-0.3321, 0.6521, 0.0158),
                                dvec3(0.0702, -0.1046, 0.8252)));
  return matrix;
}

// From the colours under the white of this temperature to those under D65, both XYZ.
glm::dmat3 adaptation(double temperature) {
  const dvec3 gain = (receptors() * d65_white()) / (receptors() * white_xyz(temperature));
  const glm::dmat3 scale(dvec3(gain.x, 0., 0.), dvec3(0., gain.y, 0.), dvec3(0., 0., gain.z));
  return glm::inverse(receptors()) * scale * receptors();
}

glm::dmat3 from_rows(const std::array<double, 9>& r) {
  return glm::transpose(
      glm::dmat3(dvec3(r[0], r[1], r[2]), dvec3(r[3], r[4], r[5]), dvec3(r[6], r[7], r[8])));
}

}  // namespace

std::optional<CameraSensor> camera_sensor(std::string_view name) {
  for (const Camera& camera : cameras)
    if (camera.name == name) return CameraSensor{from_rows(camera.rows), camera.rms, camera.worst};
  return std::nullopt;
}

const std::vector<std::string_view>& camera_sensor_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Camera& camera : cameras) list.push_back(camera.name);
    return list;
  }();
  return names;
}

glm::dmat3 camera_white_balance(double temperature) {
  const glm::dmat3 from_reference = adaptation(temperature) * glm::inverse(adaptation(6500.));
  return rec709_from_xyz() * from_reference * glm::inverse(rec709_from_xyz());
}

}  // namespace pssmlt
