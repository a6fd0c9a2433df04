#include "core/measured/measured_brdf.h"

#include <fstream>

#include "core/base/error.h"
#include "core/measured/merl_brdf.h"
#include "core/measured/rgl_brdf.h"
#include "core/measured/tensor_file.h"

namespace pssmlt {

std::shared_ptr<const MeasuredBrdf> read_measured_brdf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string start(12, ' ');
  if (!in.read(start.data(), 12)) throw Error("the file cannot be read, or is too short");
  in.close();
  if (TensorFile::recognises(start)) return std::make_shared<RglBrdf>(path);
  if (MerlBrdf::recognises(start)) return std::make_shared<MerlBrdf>(path);
  throw Error("this is neither a tensor file (.bsdf) nor a MERL table (.binary)");
}

}  // namespace pssmlt
