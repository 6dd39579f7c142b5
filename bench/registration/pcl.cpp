// Registration of a scene by PCL, for run.py, which compiles it:
//
//     pcl METHOD VOXEL SOURCE TARGET GATE NEIGHBOURS SECONDS START (16 numbers, row by row)
//
// METHOD is plane, point or gicp; VOXEL 0 takes all points. A call is repeated for SECONDS of processor
// time after one that is not counted; for 0 s, that one is all.

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>

#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>

using Pose = Eigen::Matrix4d;
template <class Point>
using Cloud = typename pcl::PointCloud<Point>::Ptr;

const int MOST_ROUNDS = 50;
// rad, m: as TIGHT of run.py
const double TURN = 1e-5, SHIFT = 1e-6;
const double GRADIENT = 1e-4;

struct Options {
    float voxel;
    double gate;
    int neighbours;
    double seconds;
    Pose start;
};

template <class Point>
Cloud<Point> seen(const char *file) {
    Cloud<Point> cloud(new pcl::PointCloud<Point>);
    std::ifstream stream(file, std::ios::binary);
    Point point;
    while (stream.read(reinterpret_cast<char *>(point.data), 3 * sizeof(float)))
        if (pcl::isXYZFinite(point)) cloud->push_back(point);
    return cloud;
}

template <class Point>
Cloud<Point> reduced(const Cloud<Point> &cloud, float voxel) {
    if (voxel == 0) return Cloud<Point>(new pcl::PointCloud<Point>(*cloud));
    Cloud<Point> few(new pcl::PointCloud<Point>);
    pcl::VoxelGrid<Point> grid;
    grid.setInputCloud(cloud);
    grid.setLeafSize(voxel, voxel, voxel);
    grid.setDownsampleAllData(false);
    grid.filter(*few);
    return few;
}

struct PointToPoint : pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ, double> {
    using Point = pcl::PointXYZ;
    // the threshold of the one is a square, of the other a cosine
    PointToPoint(const Cloud<Point> &, const Options &) {
        setTransformationEpsilon(SHIFT * SHIFT);
        setTransformationRotationEpsilon(std::cos(TURN));
    }
};

struct PointToPlane : pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal, double> {
    using Point = pcl::PointNormal;
    // gives the target its normals; their tree serves the rounds as well.
    PointToPlane(const Cloud<Point> &target, const Options &options) {
        pcl::search::KdTree<Point>::Ptr tree(new pcl::search::KdTree<Point>);
        pcl::NormalEstimation<Point, Point> normals;
        normals.setInputCloud(target);
        normals.setSearchMethod(tree);
        normals.setKSearch(options.neighbours);
        normals.compute(*target);
        setSearchMethodTarget(tree, true);
        setTransformationEpsilon(SHIFT * SHIFT);
        setTransformationRotationEpsilon(std::cos(TURN));
    }
};

struct Generalized : pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ, double> {
    using Point = pcl::PointXYZ;
    Generalized(const Cloud<Point> &, const Options &) {
        setTransformationEpsilon(SHIFT);
        setRotationEpsilon(TURN);
        // at their defaults of 0.01 the answer may be 2 mm off
        setTranslationGradientTolerance(GRADIENT);
        setRotationGradientTolerance(GRADIENT);
    }
};

template <class Method, class Point = typename Method::Point>
Pose registered(const Cloud<Point> &all_source, const Cloud<Point> &all_target, const Options &options) {
    Cloud<Point> source = reduced<Point>(all_source, options.voxel);
    Cloud<Point> target = reduced<Point>(all_target, options.voxel);
    Method method(target, options);
    method.setMaxCorrespondenceDistance(options.gate);
    method.setMaximumIterations(MOST_ROUNDS);
    method.setInputSource(source);
    method.setInputTarget(target);
    pcl::PointCloud<Point> moved;
    method.align(moved, options.start);
    return method.getFinalTransformation();
}

double processor_seconds() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

template <class Method>
void measure(const char *source_file, const char *target_file, const Options &options) {
    auto source = seen<typename Method::Point>(source_file), target = seen<typename Method::Point>(target_file);
    double begun = processor_seconds();
    Pose answer = registered<Method>(source, target, options);
    double spent = processor_seconds() - begun;
    int calls = 1;
    if (options.seconds > 0) {
        begun = processor_seconds();
        for (calls = 0; calls == 0 || spent < options.seconds; calls++) {
            registered<Method>(source, target, options);
            spent = processor_seconds() - begun;
        }
    }
    std::printf("{\"ms\": %.17g, \"transform\": [", 1e3 * spent / calls);
    for (int k = 0; k < 16; k++) std::printf(k ? ", %.17g" : "%.17g", answer(k / 4, k % 4));
    std::printf("]}\n");
}

int main(int count, char **arguments) {
    if (count != 24) return 1;
    auto number = [&](int k) { return std::stod(arguments[k]); };
    Options options{float(number(2)), number(5), int(number(6)), number(7), Pose()};
    for (int k = 0; k < 16; k++) options.start(k / 4, k % 4) = number(8 + k);
    std::string method = arguments[1];
    auto run = method == "plane"   ? measure<PointToPlane>
               : method == "point" ? measure<PointToPoint>
                                   : measure<Generalized>;
    run(arguments[3], arguments[4], options);
}
