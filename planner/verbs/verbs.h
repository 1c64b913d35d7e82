// Every verb that works on a case or on a run. What the program says about itself (completion, man) is made in
// planner/cli/command_line.cpp, from these.
#pragma once

#include <memory>
#include <vector>

#include "planner/cli/verb.h"

namespace stillhook {

std::unique_ptr<Verb> check_verb();
std::unique_ptr<Verb> hydro_verb();
std::unique_ptr<Verb> simulate_verb();
std::unique_ptr<Verb> plan_verb();
std::unique_ptr<Verb> tune_verb();
std::unique_ptr<Verb> fit_verb();
std::unique_ptr<Verb> operability_verb();
std::unique_ptr<Verb> campaign_verb();
std::unique_ptr<Verb> worker_verb();
std::unique_ptr<Verb> weather_verb();
std::unique_ptr<Verb> report_verb();
std::unique_ptr<Verb> export_verb();
std::unique_ptr<Verb> schema_verb();

/// All of them, in the order in which the help lists them.
std::vector<std::unique_ptr<Verb>> all_verbs();

}  // namespace stillhook
