"""Linear 3-D face models: the container, files of many makers, fitting, learning."""
