// Position automata (Glushkov 1961): every letter of the expression is a state, and what may follow
// it is read off the syntax. Both directions are made deterministic by sets of positions.
#include "core/path/path_expression.h"

#include <bitset>
#include <map>
#include <set>
#include <utility>

#include "core/scene/features.h"

namespace pssmlt {
namespace {

constexpr size_t max_letters = 256;
constexpr size_t max_text = 1000;
constexpr size_t max_states = 2000;

using Set = std::bitset<max_letters>;

// Bits of letters; those of lights in the order of LightLetter.
enum Letter : uint8_t {
  area = 1,
  infinite = 2,
  delta_light = 4,
  diffuse = 8,
  specular = 16,
  eye = 32,
  volume = 64
};

uint8_t light_mask(LightLetter light) {
  constexpr uint8_t masks[] = {area, infinite, delta_light, volume};
  return masks[static_cast<size_t>(light)];
}
uint8_t vertex_mask(bool delta) { return delta ? specular : diffuse; }

uint8_t mask_of(char c) {
  switch (c) {
    case 'A':
      return area;
    case 'I':
      return infinite;
    case 'P':
      return delta_light;
    case 'V':
      return volume;
    case 'L':
      return area | infinite | delta_light | volume;
    case 'D':
      return diffuse;
    case 'S':
      return specular;
    case '.':
      return diffuse | specular;
    case 'E':
      return eye;
    default:
      return 0;
  }
}

struct SetLess {
  bool operator()(const Set& a, const Set& b) const {
    const Set differ = a ^ b;
    for (size_t i = 0; i < max_letters; ++i)
      if (differ[i]) return b[i];
    return false;
  }
};

// Parses the expression into positions with their successors. One conjunct a part between '&'.
class Syntax {
 public:
  Syntax(std::string_view text, const Location& where) : text_(text), where_(where) {
    if (text.size() > max_text) fail("... is longer than 1000 characters");
    do {
      const size_t from = letters_.size();
      const Part whole = alternatives();
      Set mine;
      for (size_t i = from; i < letters_.size(); ++i) mine.set(i);
      conjuncts_.push_back({whole.first, whole.last, mine});
    } while (take('&'));
    skip_spaces();
    if (at_ < text_.size()) fail_here();
  }

  struct Conjunct {
    Set first, last, all;
  };
  const std::vector<Conjunct>& conjuncts() const { return conjuncts_; }
  size_t size() const { return letters_.size(); }
  Set follow(size_t position) const { return follow_[position]; }
  bool accepts(size_t position, uint8_t mask) const { return (letters_[position] & mask) != 0; }

 private:
  struct Part {
    bool empty = true;  // matches the empty path
    Set first, last;
  };

  Part alternatives() {
    Part out = sequence();
    while (take('|')) {
      const Part other = sequence();
      out.empty |= other.empty;
      out.first |= other.first;
      out.last |= other.last;
    }
    return out;
  }

  Part sequence() {
    Part out = repeated();
    for (;;) {
      skip_spaces();
      if (at_ >= text_.size() || text_[at_] == '|' || text_[at_] == ')' || text_[at_] == '&')
        return out;
      const Part next = repeated();
      link(out.last, next.first);
      out.first |= out.empty ? next.first : Set();
      out.last = next.last | (next.empty ? out.last : Set());
      out.empty &= next.empty;
    }
  }

  Part repeated() {
    Part out = single();
    for (;;) {
      if (take('*')) {
        link(out.last, out.first);
        out.empty = true;
      } else if (take('+')) {
        link(out.last, out.first);
      } else if (take('?')) {
        out.empty = true;
      } else {
        return out;
      }
    }
  }

  Part single() {
    if (take('(')) {
      const Part inside = alternatives();
      if (!take(')')) fail_here("')' is missing");
      return inside;
    }
    const uint8_t mask = at_ < text_.size() ? mask_of(text_[at_]) : uint8_t{0};
    if (mask == 0) fail_here();
    if (letters_.size() == max_letters) fail("has more than 256 letters");
    ++at_;
    Part out;
    out.empty = false;
    out.first.set(letters_.size());
    out.last = out.first;
    letters_.push_back(mask);
    follow_.emplace_back();
    return out;
  }

  void link(const Set& from, const Set& to) {
    for (size_t i = 0; i < letters_.size(); ++i)
      if (from[i]) follow_[i] |= to;
  }
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(where_, "path expression \"" + std::string(text_.substr(0, 80)) + "\" " + what);
  }
  [[noreturn]] void fail_here(
      const std::string& expected = "A, I, P, V, L, D, S, '.', E or '(' expected") const {
    const std::string found =
        at_ < text_.size() ? "'" + std::string(1, text_[at_]) + "'" : std::string("its end");
    fail("has " + found + " at character " + std::to_string(at_ + 1) + ": " + expected);
  }

  std::string_view text_;
  Location where_;
  size_t at_ = 0;
  std::vector<uint8_t> letters_;
  std::vector<Set> follow_;
  std::vector<Conjunct> conjuncts_;
};

}  // namespace

// Makes one direction deterministic: states are sets of positions reached at the same time.
class PathAutomaton {
 public:
  using State = PathExpression::State;

  // The tables of `e` for the parsed expression.
  static void build(const Syntax& syntax, PathExpression& e, const Location& where) {
    std::vector<Set> follow(syntax.size()), precede(syntax.size());
    for (size_t i = 0; i < syntax.size(); ++i) {
      follow[i] = syntax.follow(i);
      for (size_t k = 0; k < syntax.size(); ++k)
        if (follow[i][k]) precede[k].set(i);
    }
    PathAutomaton light(syntax, follow, where), camera(syntax, precede, where);
    e.light_dead_ = light.state(Set());
    e.camera_dead_ = camera.state(Set());
    Set first, last;
    for (const auto& c : syntax.conjuncts()) first |= c.first, last |= c.last;
    for (const LightLetter l : light_letters)
      e.light_start_[static_cast<size_t>(l)] = light.state(light.only(first, light_mask(l)));
    e.camera_start_ = camera.state(camera.only(last, eye));
    e.light_step_ = light.close();
    e.camera_step_ = camera.close();
    e.camera_states_ = static_cast<uint32_t>(camera.sets_.size());
    join(syntax, follow, light, camera, e);
  }

 private:
  PathAutomaton(const Syntax& syntax, const std::vector<Set>& next, const Location& where)
      : syntax_(syntax), next_(next), where_(where) {}

  Set only(const Set& set, uint8_t mask) const {
    Set out;
    for (size_t i = 0; i < syntax_.size(); ++i)
      if (set[i] && syntax_.accepts(i, mask)) out.set(i);
    return out;
  }
  // Index of a set; those in which a conjunct has died are one and the same.
  State state(Set set) {
    for (const auto& c : syntax_.conjuncts())
      if ((set & c.all).none()) set.reset();
    const auto [found, fresh] = index_.emplace(set, static_cast<State>(sets_.size()));
    if (fresh) sets_.push_back(set);
    if (sets_.size() > max_states) throw Error(where_, "path expression is too complicated");
    return found->second;
  }
  // All states that can be reached, and the table of steps.
  std::vector<State> close() {
    std::vector<State> steps;
    for (size_t s = 0; s < sets_.size(); ++s) {
      Set after;
      for (size_t i = 0; i < syntax_.size(); ++i)
        if (sets_[s][i]) after |= next_[i];
      for (const bool delta : {false, true})
        steps.push_back(state(only(after, vertex_mask(delta))));
    }
    return steps;
  }
  static void join(const Syntax& syntax, const std::vector<Set>& follow, const PathAutomaton& light,
                   const PathAutomaton& camera, PathExpression& e) {
    e.accepts_all_ = true;
    for (size_t l = 0; l < light.sets_.size(); ++l) {
      Set after;
      for (size_t i = 0; i < syntax.size(); ++i)
        if (light.sets_[l][i]) after |= follow[i];
      for (const Set& c : camera.sets_) {
        bool all = true;
        for (const auto& part : syntax.conjuncts()) all &= (after & c & part.all).any();
        e.joins_.push_back(all ? 1 : 0);
      }
    }
    e.accepts_all_ = all_join(e);
  }
  // Do all states that paths lead to join? (The dead state is there even if none leads to it.)
  static bool all_join(const PathExpression& e) {
    const std::vector<State> lights = reached({e.light_start_, e.light_start_ + 4}, e.light_step_);
    const std::vector<State> cameras = reached({e.camera_start_}, e.camera_step_);
    for (const State l : lights)
      for (const State c : cameras)
        if (!e.joins(l, c)) return false;
    return true;
  }
  static std::vector<State> reached(std::vector<State> list, const std::vector<State>& steps) {
    std::set<State> seen(list.begin(), list.end());
    for (size_t i = 0; i < list.size(); ++i)
      for (size_t k = 0; k < 2; ++k) {
        const State next = steps[list[i] * 2u + k];
        if (seen.insert(next).second) list.push_back(next);
      }
    return list;
  }

  const Syntax& syntax_;
  const std::vector<Set>& next_;
  Location where_;
  std::vector<Set> sets_;
  std::map<Set, State, SetLess> index_;
};

PathExpression::PathExpression(std::string_view text, const Location& where) : text_(text) {
  PathAutomaton::build(Syntax(text, where), *this, where);
}

bool PathExpression::matches(std::string_view path) const {
  constexpr std::string_view lights = "AIPV";
  if (path.size() < 2 || path.back() != 'E') return false;
  const size_t light = lights.find(path.front());
  if (light == std::string_view::npos) return false;
  State s = light_start_[light];
  for (const char c : path.substr(1, path.size() - 2)) {
    if (c != 'D' && c != 'S') return false;
    s = light_step(s, c == 'S');
  }
  return joins(s, camera_start_);
}

bool PathExpression::disjoint(const PathExpression& a, const PathExpression& b,
                              const SceneFeatures& scene, int min_bounces, int max_bounces) {
  using Pair = std::pair<State, State>;
  std::set<Pair> level;
  const bool present[] = {scene.area_lights, scene.infinite_lights, scene.delta_lights,
                          scene.emitting_media};
  for (const LightLetter l : light_letters)
    if (present[static_cast<size_t>(l)]) level.insert({a.from_light(l), b.from_light(l)});
  for (int bounces = 0; bounces <= max_bounces && !level.empty(); ++bounces) {
    std::set<Pair> next;
    for (const auto& [sa, sb] : level) {
      if (a.light_dead(sa) || b.light_dead(sb)) continue;
      if (bounces >= min_bounces && a.joins(sa, a.camera_start_) && b.joins(sb, b.camera_start_))
        return false;
      if (scene.connectible) next.insert({a.light_step(sa, false), b.light_step(sb, false)});
      if (scene.specular) next.insert({a.light_step(sa, true), b.light_step(sb, true)});
    }
    level = std::move(next);
  }
  return true;
}

}  // namespace pssmlt
