#include "app/compare/distributions.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace pssmlt::compare {
namespace bm = boost::math;

double student_95(double degrees) {
  return bm::quantile(bm::complement(bm::students_t(degrees), 0.025));
}

double student_tail(double value, double degrees) {
  if (std::isinf(value)) return 0.0;
  return 2.0 * bm::cdf(bm::complement(bm::students_t(degrees), std::fabs(value)));
}

double chi_square_tail(double value, double degrees) {
  if (std::isinf(value)) return 0.0;
  return bm::cdf(bm::complement(bm::chi_squared(degrees), std::max(value, 0.0)));
}

double normal_deviation(double tail) {
  // The quantile of 0 is infinite; sums of squares shall stay finite.
  const double p = std::max(0.5 * tail, std::numeric_limits<double>::min());
  return std::max(0.0, bm::quantile(bm::complement(bm::normal(), p)));
}

}  // namespace pssmlt::compare
