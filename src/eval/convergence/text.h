#pragma once
// What bench convergence prints and writes: a table for people, results as CSV and JSON, and the journal of single
// frames that a killed run is taken up from.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eval/bench_subject.h"
#include "eval/convergence/crops.h"
#include "eval/convergence/rows.h"
#include "frame/reference_image.h"

namespace defocus {

// ---- for people -----------------------------------------------------------------------------------------------------

std::string convergenceHeader();                         // two lines
std::string convergenceLine(const ConvergenceRow& row);  // one line
// The reference, the rows that no other beats, and the bias floors, in sentences; who takes how long to which error.
std::string convergenceSummary(std::span<const ConvergenceRow> rows, const ReferenceImage& reference);

// ---- results --------------------------------------------------------------------------------------------------------

// What the rows were measured on and with.
struct ConvergenceSubject {
    BenchSubject bench;
    std::vector<Crop> crops;
    struct LeftOut {
        std::string method;
        std::string setting;
        std::string reason;
    };
    std::vector<LeftOut> leftOut;
};

// The file names, under the results' folder, of a row's image and its FLIP map.
std::string imageName(std::string_view method, std::string_view setting, std::uint32_t asked);
inline constexpr float errorMapFullScale = 0.25f;  // the FLIP that is drawn brightest: most errors are small
std::string errorMapName(std::string_view method, std::string_view setting, std::uint32_t asked);

std::string convergenceCsv(std::span<const ConvergenceRow> rows);
std::string convergenceJson(std::span<const ConvergenceRow> rows, const ReferenceImage& reference,
                            const ConvergenceSubject& subject);

// ---- journal --------------------------------------------------------------------------------------------------------

// One line a frame, numbers to their last bit. `subject` stands for all that frames of one journal must have in common
// (scene, reference, device, program).
std::string runsCsv(std::span<const ConvergenceRun> runs, std::uint64_t subject);

// The runs of a journal, whatever byte it was cut off at: a last line without its end is dropped. Throws Error, naming
// the file `name`, for another subject and for lines that are no runs.
std::vector<ConvergenceRun> readRunsCsv(std::string_view text, std::uint64_t subject, const std::string& name);

}  // namespace defocus
