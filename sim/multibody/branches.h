// Which branches the law of an element took at one state, so that it can be followed along the same ones at states
// nearby: at a kink (a wire that goes slack, a point that touches, a winch at its limit) a difference between two states
// on either side of it is the derivative of neither.
//
//   dF/dp = (F_b(p + w/2) - F_b(p - w/2)) / w        b the branches that F takes at p
//
// F_b is the formula of the branches b, whether or not their conditions hold where it is evaluated: a slack wire's zero,
// or k d + c ddot of a taut one even for a d just below zero. It is smooth where F is not. This is the derivative of the
// run itself, since the law is continuous at its kinks: a run whose steps all lie inside branches keeps them when p
// changes a little.
#pragma once

#include <cstddef>
#include <vector>

namespace stillhook {

class Branches {
 public:
  /// From here on conditions are answered as they are, and noted.
  void record() {
    taken_.clear();
    replaying_ = false;
  }
  /// From here on they are answered as noted, from the first on.
  void replay() {
    next_ = 0;
    replaying_ = true;
  }
  bool take(bool condition) {
    if (!replaying_) {
      taken_.push_back(condition);
      return condition;
    }
    return next_ < taken_.size() ? taken_[next_++] : condition;
  }

 private:
  std::vector<bool> taken_;
  std::size_t next_ = 0;
  bool replaying_ = false;
};

/// `condition`, or what it was when the branches were recorded.
inline bool on_branch(Branches* branches, bool condition) { return branches ? branches->take(condition) : condition; }

}  // namespace stillhook
