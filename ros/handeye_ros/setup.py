from setuptools import setup

NAME = 'handeye_ros'

setup(
    name=NAME,
    version='0.1.0',
    description='Hand-eye calibration of a ROS bag by the program handeye',
    maintainer='The handeye authors',
    maintainer_email='handeye@example.org',
    license='MIT OR Apache-2.0',
    packages=[NAME],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + NAME]),
        ('share/' + NAME, ['package.xml']),
        ('share/' + NAME + '/launch', ['launch/calibration.launch.py']),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    entry_points={'console_scripts': ['calibrate = handeye_ros.calibrate:main']},
)
