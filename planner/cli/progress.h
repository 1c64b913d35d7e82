// Progress on stderr: a bar that is redrawn on a terminal, a plain line now and then otherwise.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace stillhook {

class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// `terminal`: redraw one line, at most ten times a second; otherwise print a line every 30 s.
  Progress(std::FILE* out, bool terminal, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` done, 0 to 1, and what to say about it.
  void update(double share, const std::string& text, Clock::time_point now = Clock::now());
  /// Removes the bar; the next thing on stderr starts on a clean line.
  void clear();

 private:
  std::string line(double share, const std::string& text, Clock::time_point now) const;

  std::FILE* out_;
  bool terminal_, quiet_, drawn_ = false;
  Clock::time_point begin_, last_;
  Clock::duration interval_;
};

/// Progress on stderr as the process finds it.
Progress stderr_progress(bool quiet);

}  // namespace stillhook
