/* The command's subcommands. Each takes its own name as argv[0] and returns the exit status. */
#ifndef LSF_TOOLS_TOOLS_H
#define LSF_TOOLS_TOOLS_H

int lsf_tool_render(int argc, char **argv);
int lsf_tool_reference(int argc, char **argv);
int lsf_tool_compare(int argc, char **argv);
int lsf_tool_info(int argc, char **argv);
int lsf_tool_plan(int argc, char **argv);
int lsf_tool_bench(int argc, char **argv);
int lsf_tool_measure(int argc, char **argv);
int lsf_tool_sandbox(int argc, char **argv);
int lsf_tool_view(int argc, char **argv);
int lsf_tool_view(int argc, char **argv);
int lsf_tool_help(int argc, char **argv);

#endif
