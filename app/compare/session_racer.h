// A session that takes turns with others. Its clock stands while another works and while pictures
// are taken.
#pragma once

#include <functional>
#include <memory>

#include "app/compare/interleave.h"
#include "core/render/session.h"

namespace pssmlt::compare {

class SessionRacer final : public Racer {
 public:
  // after_round: called with the clock held, once there is a picture; may be empty.
  SessionRacer(BuiltScene scene, RenderSettings settings,
               std::function<void(SessionRacer&)> after_round);
  double elapsed() const override { return session_ ? session_->elapsed() : 0.0; }
  // The first call makes the session and bootstraps, which counts.
  void round() override;
  // Makes the session, resuming its checkpoint if the settings say so. Throws Error.
  void prepare();
  bool has_picture() const { return session_ && session_->has_picture(); }
  Session& session() { return *session_; }
  const BuiltScene& scene() const { return scene_; }

 private:
  BuiltScene scene_;
  RenderSettings settings_;
  RenderCallbacks callbacks_;
  std::function<void(SessionRacer&)> after_round_;
  std::unique_ptr<Session> session_;
};

}  // namespace pssmlt::compare
