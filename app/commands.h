// The subcommands of the pssmlt command, one file each. They get the arguments after the name and
// return the exit code: 0 done, 1 failure, 2 bad input or usage, 3 incomplete (stress), 130
// interrupted. Errors are thrown.
#pragma once

#include <string>
#include <vector>

namespace pssmlt {

using Arguments = std::vector<std::string>;

int run_render(const Arguments& arguments);
int run_compare(const Arguments& arguments);
int run_plugins(const Arguments& arguments);
int run_info(const Arguments& arguments);
int run_error(const Arguments& arguments);
int run_convert(const Arguments& arguments);
int run_merge(const Arguments& arguments);
int run_stress(const Arguments& arguments);
int run_version();

}  // namespace pssmlt
