"""What was done and why, told to people: trace, history, explanation, timings, drawings, the terminal."""
