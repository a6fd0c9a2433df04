#include "app/compare/session_racer.h"

namespace pssmlt::compare {

SessionRacer::SessionRacer(BuiltScene scene, RenderSettings settings,
                           std::function<void(SessionRacer&)> after_round)
    : scene_(std::move(scene)),
      settings_(std::move(settings)),
      after_round_(std::move(after_round)) {}

void SessionRacer::prepare() {
  auto session = std::make_unique<Session>(scene_, settings_, callbacks_);
  session->prepare();
  session->hold();
  session_ = std::move(session);
}

void SessionRacer::round() {
  if (!session_) prepare();
  session_->go_on();
  session_->step();
  session_->hold();
  if (after_round_ && session_->has_picture()) after_round_(*this);
}

}  // namespace pssmlt::compare
