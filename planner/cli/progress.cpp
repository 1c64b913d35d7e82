#include "planner/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "planner/text_number.h"

namespace stillhook {

Progress::Progress(std::FILE* out, bool terminal, bool quiet)
    : out_(out),
      terminal_(terminal),
      quiet_(quiet),
      begin_(Clock::now()),
      last_(begin_),
      interval_(terminal ? std::chrono::milliseconds(100) : std::chrono::seconds(30)) {
  // A terminal shows at once that something is going on.
  if (terminal_) last_ -= interval_;
}

Progress::~Progress() { clear(); }

std::string Progress::line(double share, const std::string& text, Clock::time_point now) const {
  const double spent = std::chrono::duration<double>(now - begin_).count();
  std::string left;
  // A first guess after a moment is worse than none.
  if (share > 0.02 && share < 1.0 && spent > 1.0)
    left = fmt::format(", about {} left", duration_text(spent * (1.0 - share) / share));
  return fmt::format("{:3.0f} %  {}{}", 100.0 * share, text, left);
}

void Progress::update(double share, const std::string& text, Clock::time_point now) {
  if (quiet_ || now - last_ < interval_) return;
  last_ = now;
  share = std::clamp(share, 0.0, 1.0);
  if (!terminal_) {
    fmt::print(out_, "{}\n", line(share, text, now));
  } else {
    constexpr int kWidth = 24;
    const int full = static_cast<int>(share * kWidth);
    fmt::print(out_, "\r\x1b[K[{:#<{}}{:.<{}}] {}", "", full, "", kWidth - full, line(share, text, now));
    drawn_ = true;
  }
  std::fflush(out_);
}

void Progress::clear() {
  if (!drawn_) return;
  fmt::print(out_, "\r\x1b[K");
  std::fflush(out_);
  drawn_ = false;
}

Progress stderr_progress(bool quiet) {
  const char* terminal = std::getenv("TERM");
  const bool redraws = isatty(STDERR_FILENO) == 1 && terminal && std::string_view(terminal) != "dumb";
  return Progress(stderr, redraws, quiet);
}

}  // namespace stillhook
