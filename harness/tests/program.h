#pragma once

#include <string>
#include <vector>

namespace rayshoot::test {

/// What a run of the program left behind.
struct Outcome {
  int status = 0;
  std::string output;
  std::string errors;
};

/// Run the built program with `arguments`, in `directory`, and wait. Output and errors are not terminals.
Outcome run_program(const std::vector<std::string>& arguments, const std::string& directory = ".");

}  // namespace rayshoot::test
