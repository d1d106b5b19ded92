// Writes and reads the journal of the command `bench convergence`. The journal has one CSV line per measured frame; see
// convergence/text.h.

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"
#include "core/parse.h"
#include "eval/convergence/text.h"

namespace defocus::engine {

namespace {

constexpr std::string_view header =
    "subject,method,form,setting,asked,run,samples,pyramidMilliseconds,setupMilliseconds,milliseconds,gpuMilliseconds,"
    "triangles,peakBytes,imageHash,mse,ssim,flip,biasMse,biasSsim,biasFlip,fault\n";
constexpr std::size_t fieldCount = 21;

std::string errorText(const ImageError& error) {
    return fmt::format("{},{},{}", error.mse, error.ssim, error.flip);
}

// Reads the fields of a CSV line in order. good() becomes false at the first malformed field.
class FieldReader {
public:
    explicit FieldReader(std::string_view line) : fields_(splitAt(line, ',')), good_(fields_.size() == fieldCount) {}

    [[nodiscard]] bool good() const { return good_; }
    // Returns whether the next field is empty, which marks an absent optional group of fields, such as those of an
    // error.
    [[nodiscard]] bool missing() const { return good_ && fields_[next_].empty(); }
    void skip(std::size_t count) { next_ += count; }

    std::string text() { return good_ ? fields_[next_++] : std::string(); }

    template <typename Number>
    void number(Number& value) {
        if (!good_) return;
        const std::optional<Number> parsed = parsedNumber<Number>(fields_[next_++]);
        good_ = parsed.has_value();
        value = parsed.value_or(value);
    }

    void hash(std::uint64_t& value) {
        if (!good_) return;
        const std::string& field = fields_[next_++];
        const auto [end, fault] = std::from_chars(field.data(), field.data() + field.size(), value, 16);
        good_ = fault == std::errc() && end == field.data() + field.size();
    }

    void error(ImageError& value) {
        number(value.mse);
        number(value.ssim);
        number(value.flip);
    }

private:
    std::vector<std::string> fields_;
    std::size_t next_ = 0;
    bool good_;
};

}  // namespace

std::string runsCsv(std::span<const ConvergenceRun> runs, std::uint64_t subject) {
    std::string text(header);
    for (const ConvergenceRun& r : runs)
        text += fmt::format("{:016x},{},{},{},{},{},{},{},{},{},{},{},{},{:016x},{},{},{}\n", subject, r.method, r.form,
                            r.setting, r.asked, r.run, r.samples, r.pyramidMilliseconds, r.setupMilliseconds,
                            r.milliseconds, r.gpuMilliseconds, r.triangles, r.peakBytes, r.imageHash,
                            errorText(r.error), r.bias ? errorText(*r.bias) : ",,", r.fault);
    return text;
}

std::vector<ConvergenceRun> readRunsCsv(std::string_view text, std::uint64_t subject, const std::string& name) {
    std::vector<ConvergenceRun> runs;
    if (text.size() < header.size() && header.starts_with(text)) return runs;
    if (!text.starts_with(header))
        fail(
            "{} is not a results file of 'defocus bench convergence'; choose another folder, or start over with "
            "--overwrite",
            name);
    std::size_t begin = header.size();
    for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string_view::npos; begin = end + 1) {
        FieldReader fields(text.substr(begin, end - begin));
        ConvergenceRun run;
        std::uint64_t measured = 0;
        fields.hash(measured);
        run.method = fields.text();
        run.form = fields.text();
        run.setting = fields.text();
        fields.number(run.asked);
        fields.number(run.run);
        fields.number(run.samples);
        fields.number(run.pyramidMilliseconds);
        fields.number(run.setupMilliseconds);
        fields.number(run.milliseconds);
        fields.number(run.gpuMilliseconds);
        fields.number(run.triangles);
        fields.number(run.peakBytes);
        fields.hash(run.imageHash);
        fields.error(run.error);
        if (fields.missing())
            fields.skip(3);
        else
            fields.error(run.bias.emplace());
        run.fault = fields.text();
        if (!fields.good())
            fail("{}: line {} does not describe a run; choose another folder, or start over with --overwrite", name,
                 runs.size() + 2);
        if (measured != subject)
            fail(
                "{} contains results for another scene, camera, size, reference, device or build of the program; "
                "choose another folder, or start over with --overwrite",
                name);
        runs.push_back(std::move(run));
    }
    return runs;
}

}  // namespace defocus::engine
