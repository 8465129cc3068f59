#!/bin/sh
# Gradescope runs this once, as root, when it builds the image. Nothing has to be installed.
tar xf /autograder/source/qdot-bundle.tar.gz -C /autograder/source
