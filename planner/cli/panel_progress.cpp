#include "planner/cli/panel_progress.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace stillhook {

HydroProgress panel_method_progress(bool quiet, const std::atomic<bool>* stop) {
  // One bar for the whole computation, made when it begins.
  auto bar = std::make_shared<std::unique_ptr<Progress>>();
  return [quiet, stop, bar](double share, const std::string& text) {
    if (!*bar) {
      if (!quiet) spdlog::info("the panel method computes the coefficients of a hull; they are kept for the next run");
      bar->reset(new Progress(stderr_progress(quiet)));  // it cannot be moved, as make_unique would
    }
    if (share < 1.0)
      (*bar)->update(share, "panel method: " + text);
    else
      bar->reset();
    return !(stop && stop->load());
  };
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
}

}  // namespace stillhook
