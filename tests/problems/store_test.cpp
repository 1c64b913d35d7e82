// The evaluation store: exact bits back, refusals, and a search that is killed and resumed.
#include "problems/search/store.h"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "problems/search/random_search.h"
#include "problems/search/search.h"
#include "tests/truth/hock_schittkowski.h"

using namespace stillhook;
namespace fs = std::filesystem;

namespace {

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "stillhook-store-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  std::string store() const { return (path_ / "evaluations.sqlite").string(); }

 private:
  fs::path path_;
};

const StoreIdentity kIdentity{"0.1.0", "name = \"a case\"\n"};

SearchProblem hs43() { return truth::inequality_problems()[3].problem; }

SearchOptions options() {
  SearchOptions o;
  o.evaluations = 90;
  o.seed = 11;
  return o;
}

/// Search and random sample on one store, as a plan does both.
std::pair<SearchReport, SearchReport> plan(const SearchProblem& problem, EvaluationStore& store) {
  SearchReport found = search(with_store(problem, store, "search"), options());
  SearchOptions sample = options();
  sample.evaluations = 15;
  return {found, random_search(with_store(problem, store, "random"), sample)};
}

/// Runs the search in a child process that dies by SIGKILL inside its n-th evaluation.
void search_and_die(const std::string& path, int n) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    SearchProblem problem = hs43();
    int calls = 0;
    problem.evaluate = [&, evaluate = problem.evaluate](const Eigen::VectorXd& x) {
      if (++calls == n) kill(getpid(), SIGKILL);
      return evaluate(x);
    };
    EvaluationStore store(path, kIdentity, problem);
    search(with_store(problem, store, "search"), options());
    _exit(7);  // not reached: the search asks for more than n
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  REQUIRE(WTERMSIG(status) == SIGKILL);
}

}  // namespace

TEST_CASE("an evaluation comes back with the same bits, found by the bits of x") {
  Folder folder;
  const SearchProblem problem = hs43();
  const Eigen::Vector4d x(0.1, -1.0 / 3, 1e-310, 4.999999999999999);
  Evaluation e;
  e.usable = true;
  e.objective = 1.0 / 7;
  e.constraints = Eigen::Vector3d(-1e-300, 0.1 + 0.2, -5e-324);
  e.details = {std::nan(""), -0.0, 1.0 / 3, INFINITY};
  e.message = "with \"quotes\", a ' and an ü";
  e.gradient_valid = true;
  e.objective_gradient = Eigen::Vector4d(1.0 / 3, 2, 3, 4);
  e.constraint_jacobian = Eigen::MatrixXd::Random(3, 4);
  {
    EvaluationStore store(folder.store(), kIdentity, problem);
    CHECK_FALSE(store.find(x));
    store.insert(x, e, "search", 1.5);
    Evaluation other = e;
    other.objective = 9;
    store.insert(x, other, "search", 1.5);  // the first one stays
  }
  EvaluationStore store(folder.store(), kIdentity, problem);
  CHECK(store.size() == 1);
  const std::optional<Evaluation> back = store.find(x);
  REQUIRE(back);
  CHECK(back->from_store);
  CHECK(back->usable);
  CHECK(back->objective == e.objective);
  CHECK(back->constraints == e.constraints);
  REQUIRE(back->details.size() == 4);
  CHECK(std::isnan(back->details[0]));
  CHECK(std::signbit(back->details[1]));
  CHECK(back->details[2] == e.details[2]);
  CHECK(back->details[3] == e.details[3]);
  CHECK(back->message == e.message);
  CHECK(back->objective_gradient == e.objective_gradient);
  CHECK(back->constraint_jacobian == e.constraint_jacobian);
  Eigen::Vector4d neighbour = x;
  neighbour[3] = std::nextafter(x[3], 0.0);
  CHECK_FALSE(store.find(neighbour));
  store.insert(Eigen::Vector4d(0.0, 0, 0, 0), e, "search", 0.0);
  CHECK(store.find(Eigen::Vector4d(-0.0, 0, 0, 0)));
}

TEST_CASE("a store of another case, another version or no store at all is refused in a sentence") {
  Folder folder;
  const SearchProblem problem = hs43();
  { EvaluationStore store(folder.store(), kIdentity, problem); }
  { EvaluationStore store(folder.store(), kIdentity, problem); }  // its own opens again
  CHECK_THROWS_WITH(EvaluationStore(folder.store(), {"0.1.0", "name = \"b\"\n"}, problem),
                    Catch::Contains("another case"));
  CHECK_THROWS_WITH(EvaluationStore(folder.store(), {"0.2.0", kIdentity.problem}, problem),
                    Catch::Contains("stillhook 0.1.0, this is 0.2.0"));
  CHECK_THROWS_AS(EvaluationStore("/nowhere/evaluations.sqlite", kIdentity, problem), StoreError);
  const std::string text = folder.store() + ".txt";
  std::ofstream(text) << std::string(4096, 'x');
  CHECK_THROWS_WITH(EvaluationStore(text, kIdentity, problem), Catch::Contains("not a usable evaluation store"));
}

TEST_CASE("a search answered from the store computes nothing again and ends at the same plan") {
  Folder folder;
  int computed = 0;
  SearchProblem problem = hs43();
  problem.evaluate = [&, evaluate = problem.evaluate](const Eigen::VectorXd& x) {
#pragma omp atomic
    ++computed;
    return evaluate(x);
  };
  EvaluationStore store(folder.store(), kIdentity, problem);
  const auto [found, sample] = plan(problem, store);
  CHECK(computed == store.size());
  CHECK(found.simulations < found.evaluations);  // the start is asked for again by ISRES
  const int before = computed;
  const auto [again, sample_again] = plan(problem, store);
  CHECK(computed == before);
  CHECK(again.simulations == 0);
  CHECK(sample_again.simulations == 0);
  CHECK(again.evaluations == found.evaluations);
  CHECK(again.best_x == found.best_x);
  CHECK(again.best.objective == found.best.objective);
  CHECK(again.best_evaluation == found.best_evaluation);
  CHECK(sample_again.best_x == sample.best_x);
}

TEST_CASE("killed anywhere, a resumed search loses nothing, repeats nothing and ends at the same plan") {
  const SearchProblem problem = hs43();
  Folder undisturbed_folder;
  EvaluationStore undisturbed(undisturbed_folder.store(), kIdentity, problem);
  const SearchReport truth = search(with_store(problem, undisturbed, "search"), options());
  for (const int n : {1, 2, 17, 46, 80}) {
    CAPTURE(n);
    Folder folder;
    search_and_die(folder.store(), n);
    EvaluationStore store(folder.store(), kIdentity, problem);
    CHECK(store.size() == n - 1);  // all but the one under way
    const SearchReport resumed = search(with_store(problem, store, "search"), options());
    CHECK(resumed.best_x == truth.best_x);
    CHECK(resumed.best.objective == truth.best.objective);
    CHECK(resumed.best_evaluation == truth.best_evaluation);
    CHECK(resumed.evaluations == truth.evaluations);
    CHECK(resumed.simulations == truth.simulations - (n - 1));
    CHECK(store.size() == undisturbed.size());
  }
}

TEST_CASE("killed twice from outside at arbitrary moments") {
  const SearchProblem problem = hs43();
  Folder undisturbed_folder, folder;
  EvaluationStore undisturbed(undisturbed_folder.store(), kIdentity, problem);
  const SearchReport truth = search(with_store(problem, undisturbed, "search"), options());
  for (int kill_number = 0; kill_number < 2; ++kill_number) {
    int channel[2];
    REQUIRE(pipe(channel) == 0);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      SearchProblem slow = problem;
      slow.evaluate = [&](const Eigen::VectorXd& x) {
        usleep(500);
        if (write(channel[1], "e", 1) != 1) _exit(8);
        return problem.evaluate(x);
      };
      EvaluationStore store(folder.store(), kIdentity, slow);
      search(with_store(slow, store, "search"), options());
      pause();
    }
    char seen = 0;
    for (int i = 0; i < 20; ++i) REQUIRE(read(channel[0], &seen, 1) == 1);
    kill(child, SIGKILL);  // somewhere between the 20th evaluation and the next: in it, in the insert, in the solver
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    close(channel[0]);
    close(channel[1]);
  }
  EvaluationStore store(folder.store(), kIdentity, problem);
  CHECK(store.size() >= 38);
  const SearchReport resumed = search(with_store(problem, store, "search"), options());
  CHECK(resumed.best_x == truth.best_x);
  CHECK(store.size() == undisturbed.size());
}

TEST_CASE("an interrupted evaluation is not stored, one that is not a number is stored as graded") {
  Folder folder;
  SearchProblem problem = hs43();
  problem.evaluate = [](const Eigen::VectorXd& x) {
    Evaluation e;
    e.usable = true;
    e.objective = std::nan("");
    e.constraints = Eigen::Vector3d::Zero();
    e.interrupted = x[0] > 0;
    return e;
  };
  EvaluationStore store(folder.store(), kIdentity, problem);
  const SearchProblem stored = with_store(problem, store, "search");
  stored.evaluate(Eigen::Vector4d(1, 0, 0, 0));
  CHECK(store.size() == 0);
  const Evaluation first = stored.evaluate(Eigen::Vector4d(-1, 0, 0, 0));
  CHECK_FALSE(first.usable);
  CHECK(std::isfinite(first.objective));
  const Evaluation second = stored.evaluate(Eigen::Vector4d(-1, 0, 0, 0));
  CHECK(second.from_store);
  CHECK(second.objective == first.objective);
  CHECK(second.constraints == first.constraints);
}
