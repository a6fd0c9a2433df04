// The directives that change the current transformation.
#include "core/scene/parser_directives.h"

namespace pssmlt {
namespace {

// The file lists the matrix column by column, which is how glm stores it.
dmat4 to_matrix(const std::array<double, 16>& values) {
  dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = values[static_cast<size_t>(i)];
  return m;
}

}  // namespace

void Parser::active_transform(const Location&) {
  const Token token = tokens().next();
  if (token.text == "All")
    state_.activate(true, true);
  else if (token.text == "StartTime")
    state_.activate(true, false);
  else if (token.text == "EndTime")
    state_.activate(false, true);
  else
    tokens().fail(token, "ActiveTransform must be followed by All, StartTime or EndTime");
}

void Parser::concat_transform(const Location& where) {
  const auto v = numbers<16>("ConcatTransform");
  state_.concatenate(to_matrix(v), where);
  record("ConcatTransform", v, false);
}

void Parser::transform(const Location& where) {
  const auto v = numbers<16>("Transform");
  state_.replace(to_matrix(v), where);
  record("Transform", v, true);
}

void Parser::translate(const Location& where) {
  const auto v = numbers<3>("Translate");
  state_.concatenate(Transform::translate({v[0], v[1], v[2]}), where);
  record("Translate", v, false);
}

void Parser::scale(const Location& where) {
  const auto v = numbers<3>("Scale");
  state_.concatenate(Transform::scale({v[0], v[1], v[2]}), where);
  record("Scale", v, false);
}

void Parser::rotate(const Location& where) {
  const auto v = numbers<4>("Rotate");
  if (v[1] == 0.0 && v[2] == 0.0 && v[3] == 0.0) fail(where, "Rotate about an axis of length 0");
  state_.concatenate(Transform::rotate(v[0], {v[1], v[2], v[3]}), where);
  record("Rotate", v, false);
}

void Parser::look_at(const Location& where) {
  const auto v = numbers<9>("LookAt");
  const dmat4 m = Transform::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!Transform::is_invertible(m))
    fail(where, "LookAt is singular: eye and target coincide, or up is along the view");
  state_.concatenate(Transform(m), where);
  record("LookAt", v, false);
}

void Parser::transform_times(const Location& where) {
  const auto v = numbers<2>("TransformTimes");
  state_.transform_times(static_cast<float>(v[0]), static_cast<float>(v[1]), where);
}

}  // namespace pssmlt
