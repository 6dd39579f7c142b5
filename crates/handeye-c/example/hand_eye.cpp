// Where a camera sits on a robot's flange, from C++: by one method, with a verdict, and the place of a scan in another.
//
//     c++ -std=c++11 -I include example/hand_eye.cpp -L ../../target/release -lhandeye_c -o hand_eye

#include "handeye.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace {

// A homogeneous matrix, row by row.
struct Pose {
    double m[16];
};

Pose multiply(const Pose &a, const Pose &b) {
    Pose c{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k) c.m[4 * i + j] += a.m[4 * i + k] * b.m[4 * k + j];
    return c;
}

Pose inverse(const Pose &a) {
    Pose b{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            b.m[4 * i + j] = a.m[4 * j + i];
            b.m[4 * i + 3] -= a.m[4 * j + i] * a.m[4 * j + 3];
        }
    b.m[15] = 1;
    return b;
}

// Turned about x, then y, then z of the fixed frame, then shifted.
Pose turned(double x, double y, double z, double tx, double ty, double tz) {
    const double cx = std::cos(x), sx = std::sin(x), cy = std::cos(y), sy = std::sin(y), cz = std::cos(z), sz = std::sin(z);
    return {{cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx, tx,
             sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx, ty,
             -sy, cy * sx, cy * cx, tz, 0, 0, 0, 1}};
}

double apart(const Pose &a, const Pose &b) {
    double most = 0;
    for (int k = 0; k < 16; ++k) most = std::fmax(most, std::fabs(a.m[k] - b.m[k]));
    return most;
}

// {"translation_m": [...], "rotation_xyzw": [...]}, for turns of less than half a turn.
std::string json(const Pose &a) {
    const double w = 0.5 * std::sqrt(1 + a.m[0] + a.m[5] + a.m[10]);
    std::ostringstream text;
    text.precision(17);
    text << "{\"translation_m\":[" << a.m[3] << "," << a.m[7] << "," << a.m[11] << "],\"rotation_xyzw\":["
         << (a.m[9] - a.m[6]) / (4 * w) << "," << (a.m[2] - a.m[8]) / (4 * w) << "," << (a.m[4] - a.m[1]) / (4 * w)
         << "," << w << "]}";
    return text.str();
}

// The text's answer, and its status.
handeye_status solve(const std::string &poses, std::string &answer) {
    char *given = nullptr;
    const handeye_status status = handeye_solve(poses.c_str(), nullptr, &given);
    answer = given == nullptr ? "" : given;
    handeye_free(given);
    return status;
}

void expect(bool is_so, const char *what) {
    if (is_so) return;
    std::fprintf(stderr, "not as expected: %s\n", what);
    std::exit(1);
}

// Uneven ground, seen from above.
std::vector<float> ground(const Pose &camera_from_ground, size_t width, size_t height) {
    std::vector<float> points;
    for (size_t row = 0; row < height; ++row)
        for (size_t column = 0; column < width; ++column) {
            const double x = 0.6 * column / width - 0.3, y = 0.6 * row / height - 0.3;
            const double z = 0.03 * std::sin(9 * x + 1) * std::cos(7 * y) + 0.02 * std::sin(17 * y + 5 * x * x);
            const double p[4] = {x, y, z, 1};
            for (int i = 0; i < 3; ++i) {
                double sum = 0;
                for (int k = 0; k < 4; ++k) sum += camera_from_ground.m[4 * i + k] * p[k];
                points.push_back(static_cast<float>(sum));
            }
        }
    return points;
}

}  // namespace

int main(int count, char **words) {
    std::printf("handeye %s\n", handeye_version());
    const Pose flange_from_camera = turned(0.1, -0.2, 0.6, 0.03, 0.05, 0.1);
    const Pose base_from_target = turned(0.2, 0.1, -0.4, 0.6, 0.1, 0.0);
    std::vector<double> robot, camera;
    std::string pairs;
    for (int k = 0; k < 12; ++k) {
        const Pose base_from_flange =
            turned(0.5 * std::sin(2.0 * k), 0.6 * std::cos(1.3 * k), 0.9 * std::sin(0.7 * k), 0.4 + 0.02 * k, 0.1, 0.5);
        const Pose camera_from_target =
            multiply(inverse(multiply(base_from_flange, flange_from_camera)), base_from_target);
        robot.insert(robot.end(), base_from_flange.m, base_from_flange.m + 16);
        camera.insert(camera.end(), camera_from_target.m, camera_from_target.m + 16);
        pairs += (k == 0 ? "" : ",");
        pairs += "{\"base_from_flange\":" + json(base_from_flange) + ",\"camera_from_target\":" + json(camera_from_target) + "}";
    }

    Pose x{}, y{};
    char *error = nullptr;
    handeye_status status = handeye_closed_form("eye-in-hand", "park-martin", 12, robot.data(), camera.data(), x.m, y.m, &error);
    expect(status == HANDEYE_ACCEPTED && error == nullptr, "a closed form solves exact poses");
    expect(apart(x, flange_from_camera) < 1e-9 && apart(y, base_from_target) < 1e-9, "its answer is the truth");

    std::string answer;
    status = solve("{\"setup\":\"eye-in-hand\",\"pairs\":[" + pairs + "]}", answer);
    expect(status == HANDEYE_ACCEPTED, "the recommended estimator accepts them");
    expect(answer.find("\"flange_from_camera\"") != std::string::npos, "its answer has a name");
    std::printf("%.100s...\n", answer.c_str());

    std::vector<double> sent(robot.size());
    status = handeye_compensate(answer.c_str(), 0, 12, robot.data(), sent.data(), nullptr, &error);
    expect(status == HANDEYE_NOT_ACCEPTED && std::strstr(error, "nothing to correct") != nullptr, "an exact robot is not corrected");
    handeye_free(error);
    expect(handeye_compensate("{}", 0, 12, robot.data(), sent.data(), nullptr, nullptr) == HANDEYE_UNUSABLE, "no calibration is refused");

    status = solve("{\"setup\":\"eye-in-hand\",\"pairs\":[}", answer);
    expect(status == HANDEYE_UNUSABLE && answer.find("\"error\"") != std::string::npos, "broken text is refused");
    std::printf("%s\n", answer.c_str());
    expect(handeye_solve(nullptr, nullptr, nullptr) == HANDEYE_WRONG_CALL, "null is refused");
    robot[5] = std::nan("");
    status = handeye_closed_form("eye-in-hand", "shah", 12, robot.data(), camera.data(), x.m, y.m, &error);
    expect(status == HANDEYE_UNUSABLE && std::strstr(error, "base_from_flange[0]") != nullptr, "NaN is named");
    handeye_free(error);

    const Pose down = turned(3.1, 0.05, 0.1, 0, 0, 0.9), aside = turned(3.0, -0.1, 0.2, 0.05, 0.02, 0.95);
    const std::vector<float> source = ground(down, 200, 200), target = ground(aside, 210, 190);
    const handeye_scan scans[2] = {{source.data(), 40000, 1}, {target.data(), 39900, 1}};
    Pose start = multiply(aside, inverse(down));
    start.m[3] += 0.004;
    char *found = nullptr;
    status = handeye_register(&scans[0], &scans[1], start.m, "{\"max_distance_mm\": 20}", &found);
    expect(status == HANDEYE_ACCEPTED, "two clouds are registered");
    std::printf("%.100s...\n", found);
    handeye_free(found);
    expect(handeye_register(&scans[0], nullptr, nullptr, nullptr, nullptr) == HANDEYE_WRONG_CALL, "a scan is needed");

    if (count > 1) {
        status = handeye_calibrate(words[1], nullptr, nullptr, &found);
        expect(status == HANDEYE_ACCEPTED, "a folder is calibrated");
        std::printf("%.100s...\n", found);
        handeye_free(found);
    }
    status = handeye_calibrate("no such folder", nullptr, nullptr, &found);
    expect(status == HANDEYE_UNUSABLE, "a folder that is not there is refused");
    handeye_free(found);
    std::printf("all as expected\n");
    return 0;
}
