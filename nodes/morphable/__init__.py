"""Linear 3-D face models: the container, files of several makers, fitting to landmarks.

Learning such a model is `graphface.nodes.learning`.
"""
