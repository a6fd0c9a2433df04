// Targets with closed forms (app/stress/toy.h), for tests of samplers without light.
#pragma once

#include "app/stress/toy.h"
#include "tests/support/make_plugin.h"

namespace pssmlt::test {

using stress::box_map;
using stress::BoxFilter;
using stress::frame_of;
using stress::ToyFilm;
using stress::ToyIntegrator;
using stress::ToyRender;

}  // namespace pssmlt::test
