"""Training: face models from photographs and heads, the network that labels from a teacher."""
