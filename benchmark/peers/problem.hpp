// The histories written by problem.py, and the report of the results common to all compiled peers.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

// A rectangular block that rocks about a corner: theory.md, sections 1 to 3, divided by its inertia
struct Wall {
   double capacity;     // q_c [rad]
   double p2;           // M g R / J [1/s2]
   double gravity;      // [m/s2]
   double restitution;  // speed after an impact / speed before it
   bool two_sided;
};

struct Record {
   double dt;              // [s]
   std::vector<double> a;  // ground acceleration / gravity
};

struct History {
   const Record *record;
   double scale;
};

struct Problem {
   Wall wall;
   std::vector<Record> records;
   std::vector<History> histories;
};

struct Outcome {
   double edp;
   bool collapsed;
   int impacts;
};

// Arguments of the command line: PROBLEM METHOD SETTING REPEATS EVERY
struct Request {
   std::string method;
   double setting;  // tolerance, or steps per sample
   int repeats;  // 0: one for each line of standard input
   int every;  // stride: run every n-th history
};

inline Problem read_problem(const char *path) {
   std::ifstream file(path, std::ios::binary | std::ios::ate);
   if (!file) {
      std::fprintf(stderr, "file %s not found\n", path);
      std::exit(2);
   }
   std::vector<double> numbers(file.tellg() / sizeof(double));
   file.seekg(0);
   file.read(reinterpret_cast<char *>(numbers.data()), numbers.size() * sizeof(double));
   const double *next = numbers.data();
   Problem problem;
   Wall &wall = problem.wall;
   wall.capacity = *next++;
   wall.p2 = *next++;
   wall.gravity = *next++;
   wall.restitution = *next++;
   wall.two_sided = *next++ != 0.0;
   problem.records.resize(static_cast<std::size_t>(*next++));
   problem.histories.resize(static_cast<std::size_t>(*next++));
   for (Record &record : problem.records) {
      record.dt = *next++;
      record.a.resize(static_cast<std::size_t>(*next++));
   }
   for (Record &record : problem.records)
      for (double &a : record.a) a = *next++ / wall.gravity;
   for (History &history : problem.histories) {
      history.record = &problem.records[static_cast<std::size_t>(*next++)];
      history.scale = *next++;
   }
   return problem;
}

// Run all histories as often as required, or each time that a line comes in; print version, seconds of each repeat, and one line per history.
// make(request, problem) returns a function of a history.
template <class Make>
int run_peer(int argc, char **argv, const std::string &version, Make make) {
   if (argc != 6) {
      std::fprintf(stderr, "usage: %s PROBLEM METHOD SETTING REPEATS EVERY\n", argv[0]);
      return 2;
   }
   const Problem problem = read_problem(argv[1]);
   const Request request{argv[2], std::atof(argv[3]), std::atoi(argv[4]), std::atoi(argv[5])};
   auto simulate = make(request, problem);
   std::printf("version %s\n", version.c_str());
   std::vector<Outcome> outcomes;
   const auto more = [&request](int repeat) {
      if (request.repeats > 0) return repeat < request.repeats;
      for (int c; (c = std::getchar()) != EOF;)
         if (c == '\n') return true;
      return false;
   };
   for (int repeat = 0; more(repeat); ++repeat) {
      outcomes.clear();
      const auto start = std::chrono::steady_clock::now();
      for (std::size_t i = 0; i < problem.histories.size(); i += request.every)
         outcomes.push_back(simulate(problem.histories[i]));
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      std::printf("seconds %.9f\n", seconds.count());
      std::fflush(stdout);
   }
   for (const Outcome &each : outcomes) std::printf("%.17g %d %d\n", each.edp, each.collapsed, each.impacts);
   return 0;
}
