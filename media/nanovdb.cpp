// Smoke, clouds and fire from a NanoVDB file (Museth 2021): its float grid "density" and, if it has
// one, its grid "temperature", from which the medium glows as a black body. Source: pbrt-v4's
// nanovdb for the parameters. The box of active voxels is unpacked into a regular grid, in which
// free flight is exact (core/media/lattice.h): memory is 4 bytes a voxel of that box.
#include <iostream>  // the headers below forget it

#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <nanovdb/util/GridValidator.h>
#include <nanovdb/util/IO.h>
#pragma GCC diagnostic pop

#include "core/media/density_medium.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

using FloatGrid = nanovdb::FloatGrid;

constexpr uint64_t most_voxels = uint64_t{1} << 31;

// The grid's map from voxel numbers to its world.
Transform index_to_world(const FloatGrid& grid) {
  const auto at = [&](double x, double y, double z) {
    const nanovdb::Vec3d p = grid.indexToWorld(nanovdb::Vec3d(x, y, z));
    return dvec3(p[0], p[1], p[2]);
  };
  const dvec3 origin = at(0, 0, 0);
  dmat4 m(1.0);
  m[0] = dvec4(at(1, 0, 0) - origin, 0.0);
  m[1] = dvec4(at(0, 1, 0) - origin, 0.0);
  m[2] = dvec4(at(0, 0, 1) - origin, 0.0);
  m[3] = dvec4(origin, 1.0);
  return Transform(m);
}

class NanoVdb final : public DensityMedium {
 public:
  static constexpr const char* summary = "density and temperature from a NanoVDB file";

  explicit NanoVdb(Parameters& p) : DensityMedium(read(p)) {}

 private:
  static DensityParts read(Parameters& p) {
    const std::string file = p.file("filename", "NanoVDB file with a grid \"density\"");
    DensityParts parts{ScatteringParameters(p, false, Rgb(1.f), Rgb(1.f)), nullptr, {}};
    read_temperature_range(p, parts.glow);
    parts.glow.factor_constant = p.number("LeScale", 1.f, "", "older name of Lescale");
    parts.glow.factor_constant =
        p.number("Lescale", parts.glow.factor_constant, "", "factor of the emission");
    if (p.describing()) return parts;
    if (parts.glow.factor_constant < 0.f) p.fail("Lescale", "\"Lescale\" must not be negative");
    if (file.empty()) p.fail("a nanovdb medium needs a \"filename\"");
    parts.density = load(p, file, "density");
    if (!parts.density) p.fail("filename", file + " has no float grid named \"density\"");
    parts.glow.temperature = load(p, file, "temperature");
    return parts;
  }

  // Null if the file has no such grid.
  static std::unique_ptr<const Lattice<float>> load(Parameters& p, const std::string& file,
                                                    const std::string& name) {
    try {
      if (!has_grid(file, name)) return nullptr;
      const auto handle = nanovdb::io::readGrid(file, name);
      const FloatGrid* const grid = handle.grid<float>();
      if (!grid) return nullptr;
      if (!nanovdb::isValid(*grid, true)) p.fail("filename", file + " is damaged");
      return unpack(p, *grid, file);
    } catch (const Error&) {
      throw;
    } catch (const std::exception& e) {
      p.fail("filename", "cannot read " + file + ": " + e.what());
    }
  }

  static bool has_grid(const std::string& file, const std::string& name) {
    for (const auto& meta : nanovdb::io::readGridMetaData(file)) {
      if (meta.gridName == name && meta.gridType == nanovdb::GridType::Float) return true;
    }
    return false;
  }

  static std::unique_ptr<const Lattice<float>> unpack(Parameters& p, const FloatGrid& grid,
                                                      const std::string& file) {
    if (grid.activeVoxelCount() == 0)
      return make_lattice({ivec3(1), vec3(0.f), vec3(1.f), {}}, {0.f});
    const auto box = grid.indexBBox();
    const auto low = box.min(), high = box.max();
    LatticeFrame frame;
    uint64_t voxels = 1;
    for (int i = 0; i < 3; ++i) {
      const int64_t extent = int64_t{high[i]} - int64_t{low[i]} + 1;
      voxels *= static_cast<uint64_t>(std::min(extent, int64_t{1} << 20));
      frame.size[i] = static_cast<int>(extent);
      frame.low[i] = static_cast<float>(low[i]) - 0.5f;
      frame.high[i] = static_cast<float>(high[i]) + 0.5f;
      if (voxels > most_voxels) p.fail("filename", file + " spans more than 2^31 voxels");
    }
    frame.to_render = p.transform() * index_to_world(grid);
    std::vector<float> values;
    values.reserve(voxels);
    const auto accessor = grid.getAccessor();
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          const float v = accessor.getValue(nanovdb::Coord(x, y, z));
          values.push_back(v > 0.f && v < infinity ? v : 0.f);
        }
      }
    }
    return make_lattice(frame, std::move(values));
  }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Medium, "nanovdb", pssmlt::NanoVdb)
