"""From YAML files to validated values, and which of them each stage uses."""
