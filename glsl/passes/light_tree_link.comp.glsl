/* The binary radix tree over sorted codes, one inner node per invocation (T. Karras 2012, "Maximizing Parallelism
 * in the Construction of BVHs, Octrees, and k-d Trees", section 4). */
#include "passes/light_tree_links.glsl"

/* Number of leading bits that two codes share; -1 past either end. */
int shared_bits(int i, int j)
{
    if (j < 0 || j >= int(tree.live))
        return -1;
    uvec2 differ = codes[i] ^ codes[j];
    return differ.x != 0u ? 31 - findMSB(differ.x) : 63 - findMSB(differ.y);
}

/* The other end of the run of codes below node i, which is one of its ends. */
int other_end(int i, int direction)
{
    int least = shared_bits(i, i - direction);
    int bound = 2;
    while (shared_bits(i, i + bound * direction) > least)
        bound *= 2;
    int length = 0;
    for (int reach = bound / 2; reach > 0; reach /= 2)
        if (shared_bits(i, i + (length + reach) * direction) > least)
            length += reach;
    return i + length * direction;
}

/* The last code of the left half: those that share more bits with the first code than the last one does. */
int split(int first, int last)
{
    int all = shared_bits(first, last);
    int low = first, high = last;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (shared_bits(first, middle) > all)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The link to the node over a run of codes; `edge` is the end of the run at which it is stored. */
uint link_to(int edge, bool alone, uint parent)
{
    parents[alone ? record_count + uint(edge) : uint(edge)] = parent;
    return alone ? LSF_LIGHT_TREE_LEAF | (codes[edge].y & CODE_ID_MASK) : uint(edge);
}

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node == 0u)
        tree.root = tree.live > 1u ? 0u
                    : tree.live == 1u ? LSF_LIGHT_TREE_LEAF | (codes[0].y & CODE_ID_MASK)
                                      : LSF_LIGHT_TREE_NONE;
    if (node + 1u >= tree.live)
        return;
    int i = int(node);
    int direction = shared_bits(i, i + 1) > shared_bits(i, i - 1) ? 1 : -1;
    int j = other_end(i, direction);
    int first = min(i, j), last = max(i, j), middle = split(first, last);
    nodes[node].left = link_to(middle, middle == first, node);
    nodes[node].right = link_to(middle + 1, middle + 1 == last, node);
    nodes[node].count = uint(last - first + 1);
    parents[visits_index(node)] = 0u;
}
