// The folder of a campaign: what every process that works on it must agree on.
//
//     manifest.json              program, executable, case, tasks: who works on it compares all of them with its own
//     case.toml                  the case as resolved
//     parts/TASK.ATTEMPT.jsonl   what one attempt at a task found, a line a run (planner/campaign/parts.h)
//     parts/TASK.ATTEMPT.crash   the attempt was ended by a signal of its own making
//     cancel                     workers end when they see it
#pragma once

#include <string>

#include "planner/operability/operability_plan.h"

namespace stillhook {

/// The manifest of a study of limiting sea states, as text. `case_text`: the content of case.toml.
std::string manifest_text(const Case& c, const OperabilityPlan& plan, const std::string& case_text);

/// A campaign as a worker finds it.
struct Campaign {
  std::string folder;
  std::string manifest;  // its text
  std::string identity;  // SHA-256 of the manifest
  Case lift;
  OperabilityPlan plan;
};

/// Opens a folder. Throws UsageError: it holds no campaign, it was made by another program or for another case.
Campaign open_campaign(const std::string& folder);

/// The same without a look at the program: to read what is there.
Campaign read_campaign(const std::string& folder);

/// What differs between the folder's manifest and this one, as a sentence with the remedy; empty if nothing does.
std::string manifest_difference(const std::string& stored, const std::string& own);

std::string manifest_path(const std::string& folder);
std::string parts_path(const std::string& folder);
std::string cancel_path(const std::string& folder);

/// SHA-256 of the program that runs, and of the values that its sine, exponential and the like give here: C libraries
/// choose them by processor.
const std::string& executable_hash();
const std::string& arithmetic_fingerprint();
std::string host_name();

}  // namespace stillhook
