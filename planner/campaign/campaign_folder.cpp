#include "planner/campaign/campaign_folder.h"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "planner/run_folder.h"
#include "planner/version.h"
#include "results/json_number.h"
#include "results/sha256.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kManifestSchema = 1;

std::string file_content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw UsageError(path + ": cannot be read: " + std::strerror(errno));
  return {std::istreambuf_iterator<char>(in), {}};
}

Json parsed_manifest(const std::string& text, const std::string& path) {
  try {
    Json document = Json::parse(text);
    if (document.at("schema").get<int>() != kManifestSchema)
      throw UsageError(fmt::format("{}: is of schema {}, this program reads {}", path, document.at("schema").get<int>(),
                                   kManifestSchema));
    return document;
  } catch (const nlohmann::json::exception& error) {
    throw UsageError(fmt::format("{}: is no manifest of a campaign: {}", path, error.what()));
  }
}

}  // namespace

std::string manifest_path(const std::string& folder) { return folder + "/manifest.json"; }
std::string parts_path(const std::string& folder) { return folder + "/parts"; }
std::string cancel_path(const std::string& folder) { return folder + "/cancel"; }

const std::string& executable_hash() {
  static const std::string hash = sha256(file_content("/proc/self/exe"));
  return hash;
}

const std::string& arithmetic_fingerprint() {
  static const std::string fingerprint = [] {
    std::string bytes;
    for (int i = 1; i <= 4000; ++i) {
      // Volatile: the compiler would work them out with its own arithmetic.
      volatile double x = 0.0137 * i;
      const std::array<double, 6> values = {std::sin(x),        std::cos(x),       std::exp(-x),
                                            std::log(x + 1e-3), std::pow(x, 1.37), std::atan2(x, 3.1)};
      bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values);
    }
    return sha256(bytes).substr(0, 16);
  }();
  return fingerprint;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string manifest_text(const Case& c, const OperabilityPlan& plan, const std::string& case_text) {
  Json document = {{"schema", kManifestSchema},
                   {"verb", "operability"},
                   {"program", kVersion},
                   {"executable_sha256", executable_hash()},
                   {"case", c.name},
                   {"case_sha256", sha256(case_text)}};
  Json& tasks = document["tasks"] = Json::array();
  for (const OperabilityColumn& column : plan.columns)
    tasks.push_back({{"peak_period_s", column.peak_period},
                     {"heading_deg", degrees_of(column.heading)},
                     {"height_max_m", column.highest}});
  return document.dump(1) + "\n";
}

std::string manifest_difference(const std::string& stored, const std::string& own) {
  if (stored == own) return {};
  const Json a = Json::parse(stored), b = Json::parse(own);
  const auto differs = [&](const char* key) { return a.value(key, Json()) != b.value(key, Json()); };
  if (differs("program"))
    return fmt::format("was begun by stillhook {}, this is {}: go on with that version, or begin anew with --force",
                       a.value("program", std::string("?")), kVersion);
  if (differs("executable_sha256"))
    return fmt::format(
        "was begun by another build of stillhook {}: results of two builds are not mixed; go on with "
        "that one, or begin anew with --force",
        kVersion);
  return "was begun for another case, or with other --set: begin anew with --force, or use another --out";
}

Campaign read_campaign(const std::string& folder) {
  Campaign campaign;
  campaign.folder = folder;
  const std::string path = manifest_path(folder);
  if (!fs::exists(path))
    throw UsageError(folder + ": holds no campaign: there is no manifest.json; stillhook operability makes one");
  campaign.manifest = file_content(path);
  campaign.identity = sha256(campaign.manifest);
  const Json document = parsed_manifest(campaign.manifest, path);
  const std::string case_file = folder + "/case.toml";
  if (document.value("case_sha256", std::string()) != sha256(file_content(case_file)))
    throw UsageError(case_file + ": is not the case that the campaign was begun with");
  campaign.lift = read_case(case_file);
  campaign.plan = operability_plan(campaign.lift);
  return campaign;
}

Campaign open_campaign(const std::string& folder) {
  Campaign campaign = read_campaign(folder);
  const std::string own = manifest_text(campaign.lift, campaign.plan, file_content(folder + "/case.toml"));
  if (const std::string difference = manifest_difference(campaign.manifest, own); !difference.empty())
    throw UsageError(folder + ": " + difference);
  return campaign;
}

}  // namespace stillhook
